#include "app/gui/ui.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/gui/ui_state.h"

namespace jnd::app::gui {
namespace {

// ImGui gives a field the keyboard one or two frames after it was asked to.
constexpr int kMaxFramesOfWaiting = 5;

}  // namespace

const Drawn::Widget* Drawn::find(std::string_view name) const {
  const auto found = std::ranges::find(widgets, name, &Widget::name);
  return found == widgets.end() ? nullptr : &*found;
}

bool Drawn::shows(std::string_view part) const {
  return std::ranges::any_of(
      texts, [&](const std::string& text) { return text.find(part) != std::string::npos; });
}

Ui::Ui(Theme& theme) : theme_(theme), my_(std::make_unique<Implementation>()) {
  my_->context = ImGui::GetCurrentContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  // Frames are drawn only when something happens, so a blinking cursor might stop while it is
  // invisible.
  io.ConfigInputTextCursorBlink = false;
  // Otherwise dragging the ground of a dialog would move its window.
  io.ConfigWindowsMoveFromTitleBarOnly = true;
  Implementation::map_keys(io);
  ImGuiStyle& style = ImGui::GetStyle();
  // Lines are drawn as shapes: the window does not smooth the letters' texture, which contains
  // ImGui's textures of lines.
  style.AntiAliasedLinesUseTex = false;
  style.WindowPadding = style.WindowMinSize = ImVec2(1, 1);
  style.WindowBorderSize = style.ChildBorderSize = style.FrameBorderSize = 0;
  style.ItemSpacing = ImVec2(0, 0);
  style.Colors[ImGuiCol_FrameBg] = style.Colors[ImGuiCol_ChildBg] =
      style.Colors[ImGuiCol_NavHighlight] = style.Colors[ImGuiCol_ScrollbarBg] =
          ImVec4(0, 0, 0, 0);
}

Ui::~Ui() = default;

void Ui::begin_frame(InputQueue& queue) {
  Implementation& my = *my_;
  ImGui::SetCurrentContext(my.context);
  // What was just used may open a dialog or a field, for which the next key is meant.
  const bool is_held = std::exchange(my.is_held, false);
  const bool is_ready =
      !std::exchange(my.was_used, false) && !my.is_waiting_for_focus() && !is_held;
  if (my.again.has_value() && !is_held) {
    my.input = *std::exchange(my.again, std::nullopt);
  } else if (is_ready) {
    my.input = queue.next_frame(!my.active_before.empty());
  } else {
    my.input = {.mouse = queue.mouse()};
  }
  my.has_more = !queue.empty();
  my.feed(ImGui::GetIO());

  my.keys = my.input.keys;
  for (const KeyEvent& event : my.keys) {
    if (event.action == KeyEvent::Action::kRelease) {
      my.released_s[event.chord.key] = ImGui::GetTime();
    }
  }
  std::erase_if(my.keys, [](const KeyEvent& event) {
    return event.action == KeyEvent::Action::kRelease;
  });
  my.characters = my.input.characters;
  my.give_keys_to_field();
  const MouseState before = my.mouse;
  my.mouse = {.x = my.input.mouse.x / theme_.scale(),
              .y = my.input.mouse.y / theme_.scale(),
              .down = my.input.mouse.down};
  my.moved_x = my.mouse.x - before.x;
  my.moved_y = my.mouse.y - before.y;
  my.went_down = my.mouse.down && !before.down;
  my.went_up = before.down && !my.mouse.down;
  if (my.went_down) {
    my.press_x = my.mouse.x;
    my.press_y = my.mouse.y;
    my.press_dialog = my.dialog_before;
  }
  my.is_repeating = false;
  my.tooltip.reset();
  my.dialog_is_new = false;
  my.dialog.clear();
  my.fields.clear();
  my.asked_for.clear();
  my.active_field.clear();
  my.area_is_active = false;
  my.drawn = {.view = std::move(my.drawn.view), .frame = my.drawn.frame + 1};

  ImGui::NewFrame();
  ImGui::SetNextWindowPos(ImVec2(0, 0));
  ImGui::SetNextWindowSize(ImGui::GetIO().DisplaySize);
  ImGui::Begin("screen", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                   ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoBringToFrontOnFocus);
}

const Drawn& Ui::drawn() const noexcept { return my_->drawn; }

bool Ui::was_held() const noexcept { return my_->was_held; }

const Drawn& Ui::end_frame() {
  Implementation& my = *my_;
  draw_tooltip();
  ImGui::End();
  ImGui::Render();
  // The dialog closed without its controls being drawn, so nobody saw this frame's keys and
  // clicks. The next frame sees them again.
  if (!my.dialog_before.empty() && my.dialog.empty() &&
      (!my.keys.empty() || !my.characters.empty() || my.went_up)) {
    my.again = {.keys = my.keys, .characters = my.characters, .mouse = my.input.mouse};
    if (my.went_up) my.mouse.down = true;
  }
  // A press while a dialog closes is meant for what was below it; a press while one opens is
  // not.
  if (my.went_down && my.dialog.empty()) my.press_dialog.clear();
  my.dialog_before = my.dialog;
  if (my.is_waiting_for_focus() && ++my.frames_of_waiting > kMaxFramesOfWaiting) {
    my.wants_focus.clear();
  }
  if (my.tab_steps != 0 && !my.fields.empty()) {
    const auto here = std::ranges::find(my.fields, my.active_before);
    const auto count = static_cast<std::ptrdiff_t>(my.fields.size());
    std::ptrdiff_t next = my.tab_steps > 0 ? 0 : count - 1;
    if (here != my.fields.end()) {
      next = (here - my.fields.begin() + my.tab_steps + count) % count;
    }
    my.wants_focus = my.fields[static_cast<std::size_t>(next)];
    my.frames_of_waiting = 0;
  }
  my.active_before = my.active_field;
  return my.drawn;
}

bool Ui::wants_another_frame() const noexcept {
  const bool has_input = my_->has_more || my_->again.has_value();
  return (has_input && !my_->is_held) || my_->was_used || my_->is_waiting_for_focus() ||
         my_->is_repeating || my_->dialog_is_new;
}

double Ui::time_s() const { return ImGui::GetTime(); }

void Ui::hold_input() noexcept { my_->is_held = true; }

void Ui::set_view(std::string_view name) { my_->drawn.view = name; }

Rect Ui::screen() const {
  const ImVec2 size = ImGui::GetIO().DisplaySize;
  return {0, 0, size.x / theme_.scale(), size.y / theme_.scale()};
}

ImDrawList& Ui::draw_list() { return *ImGui::GetWindowDrawList(); }

float Ui::px(float logical) const noexcept { return logical * theme_.scale(); }

std::uint32_t Ui::rgba(Colour colour, float alpha) const { return theme_.rgba(colour, alpha); }

float Ui::mouse_x() const { return my_->mouse.x; }

float Ui::mouse_y() const { return my_->mouse.y; }

bool Ui::hovered(const Rect& place) const { return my_->mouse_is_on(place); }

void Ui::log_widget(std::string_view name, std::string_view label, const Chord& key,
                    const Rect& place, bool enabled) {
  my_->drawn.widgets.push_back({.name = std::string(name),
                                .label = std::string(label),
                                .key = words(key),
                                .key_cap = printed_words(key),
                                .place = my_->visible(place),
                                .enabled = enabled && !my_->is_blocked(),
                                .is_covered = my_->is_blocked()});
  log_text(label);
}

void Ui::log_line(const Rect& letters, Drawn::Line line) {
  line.place = my_->visible(letters);
  if (line.words.empty() || line.place.width * line.place.height <= 0) return;
  line.is_cut |= line.place.width < letters.width - 1;
  line.is_covered = my_->is_blocked();
  my_->drawn.lines.push_back(std::move(line));
}

void Ui::log_text(std::string_view words) {
  if (!words.empty()) my_->drawn.texts.emplace_back(words);
}

void Ui::note_drawn(std::string_view what, const Rect& place) {
  if (place.width > 0) log_widget(what, "", {}, place, true);
  log_text(what);
}

}  // namespace jnd::app::gui
