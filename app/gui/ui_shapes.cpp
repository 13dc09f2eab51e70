#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/gui/text_layout.h"
#include "app/gui/ui.h"
#include "app/gui/ui_state.h"

namespace jnd::app::gui {
namespace {

/// The corners are on whole pixels, so that lines are sharp.
struct Corners {
  ImVec2 low, high;
};

Corners corners(const Ui& ui, const Rect& place) {
  const auto snap = [&](float logical) { return std::round(ui.px(logical)); };
  return {{snap(place.x), snap(place.y)}, {snap(place.right()), snap(place.bottom())}};
}

}  // namespace

void Ui::fill(const Rect& place, Colour colour, float rounding, float alpha) {
  const auto [low, high] = corners(*this, place);
  draw_list().AddRectFilled(low, high, rgba(colour, alpha), px(rounding));
}

void Ui::outline(const Rect& place, Colour colour, float rounding, float thickness) {
  const auto [low, high] = corners(*this, place);
  draw_list().AddRect(low, high, theme_.line_rgba(colour), px(rounding), 0,
                      std::max(1.0f, std::round(px(thickness))));
}

void Ui::card(const Rect& place) {
  fill(place, Colour::kCard, 10);
  outline(place, Colour::kLine, 10);
}

void Ui::line(float x0, float y0, float x1, float y1, Colour colour, float thickness) {
  const float width = std::max(1.0f, px(thickness));
  if (x0 == x1 || y0 == y1) {
    // A horizontal or vertical line is a rectangle on whole pixels, so that it is not smeared
    // over two rows of them.
    const float half = width / 2;
    ImVec2 low(px(std::min(x0, x1)), px(std::min(y0, y1)));
    ImVec2 high(px(std::max(x0, x1)), px(std::max(y0, y1)));
    (x0 == x1 ? low.x : low.y) -= half;
    low = ImVec2(std::round(low.x), std::round(low.y));
    (x0 == x1 ? high.x : high.y) = (x0 == x1 ? low.x : low.y) + std::round(width);
    high = ImVec2(std::round(high.x), std::round(high.y));
    draw_list().AddRectFilled(low, high, theme_.line_rgba(colour));
    return;
  }
  draw_list().AddLine(ImVec2(px(x0), px(y0)), ImVec2(px(x1), px(y1)), theme_.line_rgba(colour),
                      width);
}

void Ui::dot(float x, float y, float radius, Colour colour) {
  draw_list().AddCircleFilled(ImVec2(px(x), px(y)), px(radius), theme_.line_rgba(colour));
}

void Ui::ring(float x, float y, float radius, Colour colour, float thickness) {
  draw_list().AddCircle(ImVec2(px(x), px(y)), px(radius), theme_.line_rgba(colour), 0,
                        std::max(1.0f, px(thickness)));
}

void Ui::check(float x, float y, float size, Colour colour) {
  const auto at = [&](float u, float v) { return ImVec2(px(x + u * size), px(y + v * size)); };
  const ImVec2 points[] = {at(-0.38f, 0.02f), at(-0.12f, 0.28f), at(0.38f, -0.26f)};
  draw_list().AddPolyline(points, 3, theme_.line_rgba(colour), 0,
                          std::max(1.0f, px(0.12f * size)));
}

void Ui::progress(const Rect& place, double ratio) {
  const float radius = place.height / 2;
  fill(place, Colour::kLine, radius);
  const auto share =
      static_cast<float>(std::isfinite(ratio) ? std::clamp(ratio, 0.0, 1.0) : 0.0);
  if (share <= 0) return;
  // The bar is at least as wide as its round ends.
  const float width = std::max(share * place.width, place.height);
  fill({place.x, place.y, std::min(width, place.width), place.height}, Colour::kBlue, radius);
}

void Ui::image(const Rect& place, std::uintptr_t texture, std::string_view what) {
  log_text(what);
  if (texture == 0) return;
  const auto [low, high] = corners(*this, place);
  // OpenGL's number of it, which Dear ImGui hands on in a pointer that nobody follows.
  // NOLINTNEXTLINE(performance-no-int-to-ptr)
  draw_list().AddImage(reinterpret_cast<ImTextureID>(texture), low, high, ImVec2(0, 1),
                       ImVec2(1, 0));
}

void Ui::tooltip(float x, float y, std::string_view words) {
  if (my_->is_blocked()) return;
  log_text(words);
  my_->tooltip = {.x = x, .y = y, .words = std::string(words)};
}

void Ui::draw_tooltip() {
  if (!my_->tooltip) return;
  const auto& [x, y, words] = *my_->tooltip;
  constexpr float kWidest = 560, kFromEdge = 4;
  const Rect bounds = screen().inset(kFromEdge);
  const float least = line_height(Font::kSmall);
  const Measure measure = [this](std::string_view part) {
    return text_width(part, Font::kSmall);
  };
  const auto lines =
      break_lines(words, std::min(kWidest, bounds.width - 20), measure, /*balanced=*/false);
  float width = 0;
  for (const std::string_view line : lines) width = std::max(width, measure(line));
  Rect place = {x + 14, 0, width + 20, least * static_cast<float>(lines.size()) + 10};
  place.y = y - place.height - 10;
  if (place.right() > bounds.right()) place.x = x - place.width - 14;
  if (place.y < bounds.y) place.y = y + 14;
  place.x = std::clamp(place.x, bounds.x, std::max(bounds.x, bounds.right() - place.width));
  place.y = std::clamp(place.y, bounds.y, std::max(bounds.y, bounds.bottom() - place.height));
  const auto [low, high] = corners(*this, place);
  ImDrawList& list = *ImGui::GetForegroundDrawList();
  list.AddRectFilled(low, high, rgba(Colour::kInk), px(6));
  ImFont* font = theme_.font(Font::kSmall);
  const float above = (px(least) - font->FontSize) / 2;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float top = low.y + px(5 + least * static_cast<float>(i)) + above;
    list.AddText(font, font->FontSize, ImVec2(std::round(low.x + px(10)), std::round(top)),
                 rgba(Colour::kCard), lines[i].data(), lines[i].data() + lines[i].size());
  }
}

}  // namespace jnd::app::gui
