#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/gui/ui.h"
#include "app/gui/ui_state.h"

namespace jnd::app::gui {
namespace {

constexpr float kBarWidth = 8;
constexpr float kWheelStep = 60;

struct Thumb {
  Rect place;
  float travel = 0;  ///< How far the thumb can move.
};

Thumb thumb_of(const Rect& place, float content_height, float offset) {
  const float track = place.height - 4;
  const float height = std::max(32.0f, track * place.height / content_height);
  Thumb thumb = {.travel = std::max(1.0f, track - height)};
  const float most = std::max(1.0f, content_height - place.height);
  thumb.place = {place.right() - kBarWidth - 2, place.y + 2 + thumb.travel * offset / most,
                 kBarWidth, height};
  return thumb;
}

}  // namespace

Rect Ui::begin_scroll(std::string_view name, const Rect& place, float content_height) {
  Implementation& my = *my_;
  auto& scroll = my.scrolls.try_emplace(std::string(name)).first->second;
  // A view that was away starts at its top again.
  if (scroll.last_frame + 1 < my.drawn.frame) scroll = {};
  scroll.last_frame = my.drawn.frame;
  scroll.place = place;
  scroll.content_height = content_height;
  const float most = std::max(0.0f, content_height - place.height);
  if (most > 0) {
    if (hovered(place) && my.input.wheel != 0) {
      scroll.offset -= kWheelStep * std::exchange(my.input.wheel, 0.0f);
    }
    const float page = 0.9f * place.height;
    if (my.take_key({.key = Key::kPageDown}, true)) scroll.offset += page;
    if (my.take_key({.key = Key::kPageUp}, true)) scroll.offset -= page;
    if (my.take_key({.key = Key::kHome}, true)) scroll.offset = 0;
    if (my.take_key({.key = Key::kEnd}, true)) scroll.offset = most;
    const Thumb thumb = thumb_of(place, content_height, scroll.offset);
    if (my.went_down && hovered(thumb.place)) scroll.grabbed_at = my.mouse.y - thumb.place.y;
    if (scroll.grabbed_at >= 0) {
      const float along = my.mouse.y - scroll.grabbed_at - place.y - 2;
      scroll.offset = most * along / thumb.travel;
    }
    if (!my.mouse.down) scroll.grabbed_at = -1;
  }
  scroll.offset = std::round(std::clamp(scroll.offset, 0.0f, most));
  my.open_scroll = name;
  my.clips.push_back(my.visible(place));
  ImGui::PushClipRect(ImVec2(std::floor(px(place.x)), std::floor(px(place.y))),
                      ImVec2(std::ceil(px(place.right())), std::ceil(px(place.bottom()))),
                      true);
  return {place.x, place.y - scroll.offset, place.width - (most > 0 ? kBarWidth + 8 : 0),
          content_height};
}

void Ui::end_scroll() {
  Implementation& my = *my_;
  const auto& scroll = my.scrolls.find(my.open_scroll)->second;
  ImGui::PopClipRect();
  my.clips.pop_back();
  if (scroll.content_height <= scroll.place.height) return;
  const Thumb thumb = thumb_of(scroll.place, scroll.content_height, scroll.offset);
  const bool is_used = scroll.grabbed_at >= 0 || hovered(thumb.place);
  fill(thumb.place, Colour::kSoft, kBarWidth / 2, is_used ? 0.75f : 0.35f);
}

void Ui::scroll_into_view(std::string_view name, float below_top, float height) {
  const auto found = my_->scrolls.find(name);
  if (found == my_->scrolls.end()) return;
  auto& scroll = found->second;
  const float last = below_top + height - scroll.place.height;
  if (scroll.offset > below_top) scroll.offset = below_top;
  if (scroll.offset < last) scroll.offset = last;
}

Rect Ui::begin_dialog(std::string_view name, float width, float height) {
  Implementation& my = *my_;
  my.dialog = name;
  my.dialog_is_new = my.dialog_before != my.dialog;
  my.inside_dialog = true;
  my.num_fields_below = my.fields.size();
  fill(screen(), theme_.dark() ? Colour::kGround : Colour::kInk, 0,
       theme_.dark() ? 0.72f : 0.45f);
  const Rect bounds = screen().inset(12);
  const Rect place =
      screen().middle(std::min(width, bounds.width), std::min(height, bounds.height));
  // Many faint frames make a shadow with soft edges.
  for (int i = 1; i <= 8; ++i) {
    const auto spread = static_cast<float>(i);
    const Rect shadow = {place.x - spread, place.y + 3 - spread / 2, place.width + 2 * spread,
                         place.height + 1.5f * spread};
    draw_list().AddRectFilled(ImVec2(px(shadow.x), px(shadow.y)),
                              ImVec2(px(shadow.right()), px(shadow.bottom())),
                              IM_COL32(0, 0, 0, 7), px(10 + spread));
  }
  card(place);
  return place.inset(28);
}

void Ui::end_dialog() { my_->inside_dialog = false; }

}  // namespace jnd::app::gui
