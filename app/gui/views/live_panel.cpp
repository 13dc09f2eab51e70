// Shows how the hand moves: speed and force over the last ten seconds, and its path.

#include <algorithm>
#include <cmath>

#include "app/gui/plot.h"
#include "app/gui/views/run_parts.h"
#include "app/language/words.h"

namespace jnd::app::gui {
namespace {

constexpr double kSeconds = 10.0;

/// An end of the axis that does not jump with every stroke: 1, 1.5, 2, 3, 5 or 7 times `least`
/// times a power of ten.
double calm_end(double largest, double least) {
  double end = least;
  for (double decade = least; end < largest; decade *= 10.0) {
    for (const double step : {1.0, 1.5, 2.0, 3.0, 5.0, 7.0, 10.0}) {
      end = decade * step;
      if (end >= largest) break;
    }
  }
  return end;
}

void draw_over_time(Ui& ui, const Rect& place, const char* title, const char* unit,
                    const std::vector<TracePoint>& trace, double TracePoint::*value,
                    double least_end, Colour colour) {
  ui.card(place);
  PlotModel plot{.title = title, .unit = unit};
  plot.x = {.minimum = -kSeconds, .maximum = 0.0, .tick_suffix = " s"};
  PlotSeries series{.colour = colour};
  double largest = 0.0;
  const double newest_s = trace.empty() ? 0.0 : trace.back().time_s;
  for (const TracePoint& point : trace) {
    series.x.push_back(point.time_s - newest_s);
    series.y.push_back(point.*value);
    largest = std::max(largest, point.*value);
  }
  plot.y = {.unit = unit, .minimum = 0.0, .maximum = calm_end(largest, least_end)};
  plot.series.push_back(std::move(series));
  (void)draw_plot(ui, place.inset(16), plot);
}

void draw_path(Ui& ui, const Rect& place, const char* name,
               const std::vector<TracePoint>& trace, double TracePoint::*up,
               const core::PlainVector& hand, double hand_up, double middle_up) {
  PlotModel plot{.axes = false};
  constexpr double kHalfWidthM = 0.45;
  const double half_height_m = kHalfWidthM * place.height / place.width;
  plot.x = {.minimum = -kHalfWidthM, .maximum = kHalfWidthM};
  plot.y = {.minimum = middle_up - half_height_m, .maximum = middle_up + half_height_m};
  plot.legend = false;
  plot.equal_scales = true;
  PlotSeries path{.colour = Colour::kBlue, .alpha = 0.35f};
  constexpr double kPathS = 4.0;
  const double newest_s = trace.empty() ? 0.0 : trace.back().time_s;
  for (const TracePoint& point : trace) {
    if (newest_s - point.time_s > kPathS) continue;
    path.x.push_back(point.x_m);
    path.y.push_back(point.*up);
  }
  plot.series.push_back(std::move(path));
  ui.outline(place, Colour::kLine, 6);
  const PlotArea area = draw_plot(ui, place.inset(2), plot);
  ui.text({place.x + 10, place.y + 6, place.width - 20, 18}, name,
          {.font = Font::kTiny, .colour = Colour::kSoft});
  ui.dot(std::clamp(area.x(hand[0]), place.x + 8, place.right() - 8),
         std::clamp(area.y(hand_up), place.y + 8, place.bottom() - 8), 7, Colour::kBlue);
}

void draw_hidden_force(Ui& ui, const Rect& place) {
  ui.card(place);
  Rect inside = place.inset(18);
  ui.heading(inside.take_top(16, 16), tr("Force on the hand"));
  ui.text(inside.take_top(30, 12), tr("within limits"),
          {.font = Font::kLarge, .colour = Colour::kGreen});
  ui.text(
      inside,
      tr("This study is double-blind: force, speed and path would tell the level, so they are "
         "not shown. Everything is recorded."),
      {.colour = Colour::kSoft, .wrap = true});
}

std::string path_words(const std::vector<TracePoint>& trace, const core::PlainVector& hand) {
  double low = 1e9;
  double high = -1e9;
  for (const TracePoint& point : trace) {
    low = std::min(low, point.x_m);
    high = std::max(high, point.x_m);
  }
  return tr("width {:.2f} m · height {:.2f} m", trace.empty() ? 0.0 : high - low, hand[2]);
}

}  // namespace

void draw_live_panel(Ui& ui, const Rect& place, const SessionView& view,
                     const std::vector<TracePoint>& trace) {
  if (view.hides_levels) return draw_hidden_force(ui, place);
  constexpr float kGap = 16;
  Rect rest = place;
  const float plot_height = std::clamp((place.height - 2 * kGap) * 0.27f, 130.0f, 230.0f);
  draw_over_time(ui, rest.take_top(plot_height, kGap), tr("Speed of the hand"), "m/s", trace,
                 &TracePoint::speed_m_per_s, 0.5, Colour::kBlue);
  draw_over_time(ui, rest.take_top(plot_height, kGap), tr("Force on the hand"), "N", trace,
                 &TracePoint::force_n, 5.0, Colour::kAmber);
  ui.card(rest);
  Rect inside = rest.inset(16);
  ui.heading(inside.take_top(16, 10), tr("Path"));
  const core::PlainVector& hand = view.telemetry.hand_position_m;
  ui.text(inside.take_bottom(22, 8), path_words(trace, hand),
          {.font = Font::kSmall, .colour = Colour::kSoft});
  const float each = (inside.height - 10) / 2;
  const Rect above = inside.take_top(each, 10);
  draw_path(ui, above, tr("from above"), trace, &TracePoint::y_m, hand, hand[1], 0.0);
  draw_path(ui, inside, tr("from the side"), trace, &TracePoint::z_m, hand, hand[2], -0.12);
}

}  // namespace jnd::app::gui
