// The pad on which the mouse moves the hand. The hand is drawn where the medium lets it go, not
// where the mouse is. That is how a fluid is felt without a device (pseudo-haptics, Lécuyer et
// al. 2000).

#include <algorithm>

#include "app/gui/views/run_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {

float pad_height(const Rect& card, float below) noexcept {
  constexpr float kGapBelow = 14;
  return std::max(90.0f, std::min(0.5f * card.height, card.height - below - kGapBelow));
}

void draw_pad(Ui& ui, const Rect& place, const SessionView& view,
              const std::vector<TracePoint>& trace, RunViewState& state) {
  // The width of the part of the workspace that the pad shows.
  constexpr double kWidthM = 0.9;
  state.pad = place;
  state.pad_m_per_px = kWidthM / place.width;
  ui.fill(place, Colour::kBlueSoft, 10);
  ui.outline(place, Colour::kLine, 10);
  const float centre_x = place.x + place.width / 2;
  const float centre_y = place.y + place.height / 2;
  const auto x_of = [&](double x_m) {
    const float x = centre_x + static_cast<float>(x_m / state.pad_m_per_px);
    return std::clamp(x, place.x + 12, place.right() - 12);
  };
  const auto y_of = [&](double y_m) {
    const float y = centre_y - static_cast<float>(y_m / state.pad_m_per_px);
    return std::clamp(y, place.y + 12, place.bottom() - 12);
  };
  // The pad shows the last second of the hand's way, the hand, and the mouse that pulls it.
  const double newest_s = trace.empty() ? 0.0 : trace.back().time_s;
  for (std::size_t i = 1; i < trace.size(); ++i) {
    if (newest_s - trace[i].time_s > 1.0) continue;
    ui.line(x_of(trace[i - 1].x_m), y_of(trace[i - 1].y_m), x_of(trace[i].x_m),
            y_of(trace[i].y_m), Colour::kLine, 3);
  }
  const core::PlainVector& hand = view.telemetry.hand_position_m;
  const float hand_x = x_of(hand[0]);
  const float hand_y = y_of(hand[1]);
  if (ui.hovered(place)) {
    ui.line(hand_x, hand_y, ui.mouse_x(), ui.mouse_y(), Colour::kAmber, 2);
    ui.dot(ui.mouse_x(), ui.mouse_y(), 4, Colour::kAmber);
  }
  ui.dot(hand_x, hand_y, 22, Colour::kBlue);
  ui.note_drawn("pad", place);
  if (!ui.hovered(place)) {
    ui.text({place.x + 12, place.y + 8, place.width - 24, 44},
            tr("Move the mouse here, to and fro: the blue hand follows through the fluid."),
            {.colour = Colour::kSoft, .align = Align::kCentre});
  } else if (place.height > 120) {
    ui.text({place.x + 12, place.bottom() - 42, place.width - 24, 34},
            tr("The line is your pull on the hand: the thicker the fluid, the longer."),
            {.font = Font::kSmall, .colour = Colour::kSoft, .align = Align::kCentre});
  }
}

}  // namespace jnd::app::gui
