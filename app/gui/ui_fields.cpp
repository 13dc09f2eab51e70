#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/gui/text_layout.h"
#include "app/gui/ui.h"
#include "app/gui/ui_state.h"

namespace jnd::app::gui {
namespace {

constexpr float kRounding = 8;
constexpr float kPadding = 12;

// ImGui 1.86 does not wrap text that is edited, so we insert line ends. A carriage return
// before a line end marks it as ours: it has no width and cannot be typed.
constexpr std::string_view kSoftBreak = "\r\n";

std::string without_soft_breaks(std::string text) {
  for (std::size_t at = text.find(kSoftBreak); at != std::string::npos;
       at = text.find(kSoftBreak, at)) {
    text.erase(at, kSoftBreak.size());
  }
  return text;
}

/// Where soft breaks belong in a text that has none, the last one first.
std::vector<int> soft_breaks(std::string_view text, float width, const Measure& measure) {
  const auto lines = break_lines(text, width, measure, false);
  std::vector<int> breaks;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto start = static_cast<int>(lines[i].data() - text.data());
    if (text[static_cast<std::size_t>(start) - 1] != '\n') breaks.push_back(start);
  }
  std::ranges::reverse(breaks);
  return breaks;
}

struct Wrapping {
  float width_px = 0;
  Measure measure;
  bool starts = false;  ///< The field has just got the keyboard.
};

std::string with_soft_breaks(std::string text, const Wrapping& wrapping) {
  for (const int at : soft_breaks(text, wrapping.width_px, wrapping.measure)) {
    text.insert(static_cast<std::size_t>(at), kSoftBreak);
  }
  return text;
}

/// Wraps the text anew after every change. ImGui keeps its cursor at the same place in the
/// words.
int wrap_edited_text(ImGuiInputTextCallbackData* data) {
  const auto& wrapping = *static_cast<const Wrapping*>(data->UserData);
  if (wrapping.starts) {
    data->CursorPos = data->SelectionStart = data->SelectionEnd = data->BufTextLen;
  }
  const std::string before(data->Buf, static_cast<std::size_t>(data->BufTextLen));
  const std::string words = without_soft_breaks(before);
  if (with_soft_breaks(words, wrapping) == before) return 0;
  for (int at = data->BufTextLen - 2; at >= 0; --at) {
    if (data->Buf[at] == '\r' && data->Buf[at + 1] == '\n') data->DeleteChars(at, 2);
  }
  for (const int at : soft_breaks(words, wrapping.width_px, wrapping.measure)) {
    data->InsertChars(at, kSoftBreak.data(), kSoftBreak.data() + kSoftBreak.size());
  }
  return 0;
}

}  // namespace

bool Ui::is_editing() const noexcept {
  return !my_->active_before.empty() || !my_->active_field.empty();
}

void Ui::copy_text(const std::string& words) { ImGui::SetClipboardText(words.c_str()); }

bool Ui::begin_field(std::string_view name, const Rect& place, const std::string& value,
                     bool focus) {
  Implementation& my = *my_;
  log_widget(name, value, {}, place, true);
  my.field_place = place;
  const bool is_active = my.active_before == name;
  const Rect ring = place.inset(-3);
  if (is_active) fill(ring, Colour::kBlue, kRounding + 3, 0.18f);
  fill(place, Colour::kCard, kRounding);
  const bool is_hovered = hovered(place);
  outline(place, is_active || is_hovered ? Colour::kBlue : Colour::kLine, kRounding,
          is_active ? 1.5f : 1.0f);
  // Nothing below a dialog can be edited; ImGui would also draw it over the dialog.
  if (my.is_blocked()) return false;

  const bool is_first_of_dialog =
      my.dialog_is_new && my.inside_dialog && my.fields.size() == my.num_fields_below;
  my.fields.emplace_back(name);
  if ((focus || is_first_of_dialog) && !is_active && my.wants_focus.empty()) {
    my.wants_focus = name;
    my.frames_of_waiting = 0;
  }
  if (my.wants_focus == name && my.frames_of_waiting == 0) ImGui::SetKeyboardFocusHere();
  ImGui::PushFont(theme_.font(Font::kBody));
  const auto colour = [&](Colour of, float alpha) {
    return ImGui::ColorConvertU32ToFloat4(rgba(of, alpha));
  };
  ImGui::PushStyleColor(ImGuiCol_Text, colour(Colour::kInk, 1));
  ImGui::PushStyleColor(ImGuiCol_TextDisabled, colour(Colour::kSoft, 1));
  ImGui::PushStyleColor(ImGuiCol_TextSelectedBg, colour(Colour::kBlue, 0.3f));
  ImGui::PushStyleColor(ImGuiCol_ScrollbarGrab, colour(Colour::kSoft, 0.35f));
  ImGui::SetCursorScreenPos(ImVec2(std::round(px(place.x)), std::round(px(place.y))));
  ImGui::SetNextItemWidth(px(place.width));
  ImGui::PushID(name.data(), name.data() + name.size());
  return true;
}

void Ui::end_field(std::string_view name, bool is_area) {
  Implementation& my = *my_;
  const bool is_active = ImGui::IsItemActive();
  ImGui::PopID();
  ImGui::PopStyleColor(4);
  ImGui::PopFont();
  if (!is_active) return;
  my.active_field = name;
  if (my.wants_focus == name) my.wants_focus.clear();
  my.area_is_active = is_area;
}

bool Ui::text_field(std::string_view name, const Rect& place, std::string& value,
                    std::string_view hint, bool focus) {
  if (!begin_field(name, place, value, focus)) {
    const Rect inside = {place.x + kPadding, place.y, place.width - 2 * kPadding, place.height};
    text(
        inside, value.empty() ? hint : value,
        {.colour = value.empty() ? Colour::kSoft : Colour::kInk, .any_length = !value.empty()});
    return false;
  }
  Font font = Font::kBody;
  if (value.empty()) {
    log_text(hint);
    // ImGui draws the hint and clips it at the field's end.
    const float room = place.width - 2 * kPadding;
    for (const Font smaller : {Font::kSmall, Font::kTiny}) {
      if (text_width(hint, font) > room + 1) font = smaller;
    }
    const float width = text_width(hint, font);
    log_line({place.x + kPadding, place.y, std::min(width, room), place.height},
             {.words = std::string(hint), .box = place, .is_cut = width > room + 1});
  }
  ImGui::PushFont(theme_.font(font));
  const float free = px(place.height) - ImGui::GetFontSize();
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding,
                      ImVec2(px(kPadding), std::round(std::max(0.0f, free / 2))));
  ImGui::InputTextWithHint("##text", std::string(hint).c_str(), &value);
  ImGui::PopStyleVar();
  ImGui::PopFont();
  end_field(name, false);
  const bool is_ended = my_->enter_for_field && my_->active_before == name;
  if (is_ended) {
    my_->enter_for_field = false;
    my_->was_used = true;
  }
  return is_ended;
}

bool Ui::text_area(std::string_view name, const Rect& place, std::string& value,
                   std::string_view hint, bool focus) {
  const ImFont& font = *theme_.font(Font::kBody);
  Wrapping wrapping;
  wrapping.width_px = px(place.width - 2 * kPadding - 10);
  wrapping.measure = [&font](std::string_view part) {
    return font.CalcTextSizeA(font.FontSize, FLT_MAX, 0, part.data(), part.data() + part.size())
        .x;
  };
  const Rect inside = place.inset(kPadding);
  if (!begin_field(name, place, value, focus)) {
    text(inside, value.empty() ? hint : value,
         {.colour = value.empty() ? Colour::kSoft : Colour::kInk, .wrap = true});
    return false;
  }
  if (value.empty() && !hint.empty()) {
    text({inside.x, inside.y, inside.width, line_height(Font::kBody)}, hint,
         {.colour = Colour::kSoft});
  }
  wrapping.starts = my_->wants_focus == name;
  std::string wrapped = with_soft_breaks(value, wrapping);
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, ImVec2(px(kPadding), px(kPadding)));
  ImGui::InputTextMultiline("##text", &wrapped, ImVec2(px(place.width), px(place.height)),
                            ImGuiInputTextFlags_CallbackAlways, wrap_edited_text, &wrapping);
  ImGui::PopStyleVar();
  end_field(name, true);
  const std::string words = without_soft_breaks(wrapped);
  if (words == value) return false;
  value = words;
  return true;
}

}  // namespace jnd::app::gui
