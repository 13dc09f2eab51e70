#include "app/gui/plot.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "app/gui/plot_drawing.h"

namespace jnd::app::gui {
namespace {

constexpr float kTickGap = 8;
constexpr float kTickHeight = 18;
constexpr float kMaxBoxWidth = 46;

/// Where a value lies between the ends of its axis, as 0 to 1. It is clamped far outside of
/// that, so that no place on the screen overflows.
double share(double value, const AxisRange& range, bool logarithmic) {
  const double ratio = logarithmic
                           ? std::log(value / range.low) / std::log(range.high / range.low)
                           : (value - range.low) / (range.high - range.low);
  return std::clamp(ratio, -100.0, 100.0);
}

std::vector<AxisTick> ticks_of(const PlotAxis& axis, const AxisRange& range, int max_count) {
  if (!axis.ticks.empty()) return axis.ticks;
  std::vector<AxisTick> ticks =
      axis.logarithmic ? logarithmic_ticks(range, max_count) : linear_ticks(range, max_count);
  for (AxisTick& tick : ticks) tick.label += axis.tick_suffix;
  return ticks;
}

float widest(const Ui& ui, const std::vector<AxisTick>& ticks) {
  float width = 0;
  for (const AxisTick& tick : ticks) {
    width = std::max(width, ui.text_width(tick.label, Font::kTiny));
  }
  return width;
}

void draw_y_ticks(Ui& ui, const PlotArea& area, const std::vector<AxisTick>& ticks) {
  for (const AxisTick& tick : ticks) {
    if (tick.value < area.y_range.low - 1e-9 * std::abs(area.y_range.low) ||
        tick.value > area.y_range.high + 1e-9 * std::abs(area.y_range.high)) {
      continue;
    }
    const float y = area.y(tick.value);
    ui.line(area.place.x, y, area.place.right(), y, Colour::kLine);
    ui.text({area.place.x - kTickGap - 100, y - 10, 100, 20}, tick.label,
            {.font = Font::kTiny, .colour = Colour::kSoft, .align = Align::kRight});
  }
}

void draw_x_ticks(Ui& ui, const PlotArea& area, const std::vector<AxisTick>& ticks) {
  float free_from = -1e6f;
  for (const AxisTick& tick : ticks) {
    if (!area.can_show(tick.value, area.y_range.high)) continue;
    const float x = area.x(tick.value);
    if (x < area.place.x - 1 || x > area.place.right() + 1) continue;
    ui.line(x, area.place.bottom(), x, area.place.bottom() + 4, Colour::kSoft);
    // On a logarithmic axis ticks crowd. A tick without room for its label keeps its line.
    const float width = ui.text_width(tick.label, Font::kTiny);
    if (x - width / 2 < free_from) continue;
    free_from = x + width / 2 + 6;
    ui.text({x - width / 2 - 1, area.place.bottom() + 6, width + 2, kTickHeight}, tick.label,
            {.font = Font::kTiny, .colour = Colour::kSoft, .align = Align::kCentre});
  }
}

bool has_legend(const PlotModel& model) {
  const auto named = std::ranges::count_if(
      model.series, [](const PlotSeries& series) { return !series.name.empty(); });
  return model.legend && named > 1;
}

constexpr float kLegendRow = 20, kLegendMark = 26, kLegendGap = 18;

/// How many rows the legend takes if each row is filled before the next one begins.
int num_legend_rows(Ui& ui, float width, const PlotModel& model) {
  int rows = 1;
  float left = width;
  for (const PlotSeries& series : model.series) {
    if (series.name.empty()) continue;
    const float needed = kLegendMark + ui.text_width(series.name, Font::kSmall);
    if (needed > left && left < width) {
      ++rows;
      left = width;
    }
    left -= needed + kLegendGap;
  }
  return rows;
}

void draw_legend(Ui& ui, Rect place, const PlotModel& model) {
  Rect strip = place.take_top(kLegendRow);
  const float whole = strip.width;
  for (const PlotSeries& series : model.series) {
    if (series.name.empty()) continue;
    const float width = ui.text_width(series.name, Font::kSmall);
    if (strip.width < width + kLegendMark && strip.width < whole) {
      strip = place.take_top(kLegendRow);
    }
    const float y = strip.y + strip.height / 2;
    switch (series.style) {
      case PlotSeries::Style::kLine:
        if (series.dashed) {
          draw_dashes(ui, ui.px(strip.x), ui.px(y), ui.px(strip.x + 18), ui.px(y),
                      ui.theme().line_rgba(series.colour), ui.px(2));
        } else {
          ui.line(strip.x, y, strip.x + 18, y, series.colour, 2.5f);
        }
        break;
      case PlotSeries::Style::kPoints:
        ui.dot(strip.x + 9, y, 4, series.colour);
        break;
      case PlotSeries::Style::kBand:
        ui.fill({strip.x, y - 5, 18, 10}, series.colour, 2, 0.3f);
        break;
    }
    strip.take_left(kLegendMark);
    ui.text(strip.take_left(std::min(width + 2, strip.width), kLegendGap), series.name,
            {.font = Font::kSmall, .colour = Colour::kSoft, .any_length = true});
  }
}

void draw_content(Ui& ui, const PlotArea& area, const PlotModel& model) {
  // Half a point outside the axes is still shown; a line that leaves them is cut off.
  const Rect clip = area.place.inset(-6);
  ImGui::PushClipRect(ImVec2(ui.px(clip.x), ui.px(clip.y)),
                      ImVec2(ui.px(clip.right()), ui.px(clip.bottom())), true);
  const auto each = [&](PlotSeries::Style style, auto draw) {
    for (const PlotSeries& series : model.series) {
      if (series.style == style) draw(ui, area, series);
    }
  };
  each(PlotSeries::Style::kBand, draw_band);
  for (const PlotMark& mark : model.marks) draw_mark(ui, area, mark);
  each(PlotSeries::Style::kLine, draw_curve);
  const float unit_width = std::abs(area.x(2.0) - area.x(1.0));
  for (const PlotBox& box : model.boxes) {
    draw_box(ui, area, box, std::min(kMaxBoxWidth, 0.5f * unit_width));
  }
  each(PlotSeries::Style::kPoints, draw_points);
  ImGui::PopClipRect();
}

std::string axis_words(const PlotAxis& axis) {
  if (axis.label.empty()) return "";
  return axis.unit.empty() ? axis.label : axis.label + " · " + axis.unit;
}

}  // namespace

float PlotArea::x(double value) const noexcept {
  return place.x + static_cast<float>(share(value, x_range, x_logarithmic)) * place.width;
}

float PlotArea::y(double value) const noexcept {
  return place.bottom() -
         static_cast<float>(share(value, y_range, y_logarithmic)) * place.height;
}

bool PlotArea::can_show(double x_value, double y_value) const noexcept {
  return std::isfinite(x_value) && std::isfinite(y_value) && (!x_logarithmic || x_value > 0) &&
         (!y_logarithmic || y_value > 0);
}

PlotArea draw_plot(Ui& ui, const Rect& place, const PlotModel& model) {
  Rect rest = place;
  if (!model.title.empty()) {
    // In charts of a study, the title is the block's name by the author, so it may have any
    // length.
    ui.heading(rest.take_top(18, 10), model.title, model.unit, Align::kLeft,
               /*any_length=*/true);
  }
  if (has_legend(model)) {
    const auto rows = static_cast<float>(num_legend_rows(ui, rest.width, model));
    draw_legend(ui, rest.take_top(rows * kLegendRow, 8), model);
  }
  PlotArea area = {.x_logarithmic = model.x.logarithmic, .y_logarithmic = model.y.logarithmic};
  const int max_y_ticks = std::clamp(static_cast<int>(rest.height / 34), 2, 8);
  area.x_range = x_range_of(model);
  area.y_range = y_range_of(model, max_y_ticks);

  std::vector<AxisTick> y_ticks;
  if (model.axes) {
    if (!model.x.label.empty()) {
      ui.text(rest.take_bottom(18), axis_words(model.x),
              {.font = Font::kTiny,
               .colour = Colour::kSoft,
               .align = Align::kCentre,
               .any_length = true});
    }
    if (!model.y.label.empty()) {
      ui.text(rest.take_top(18, 4), axis_words(model.y),
              {.font = Font::kTiny, .colour = Colour::kSoft, .any_length = true});
    }
    rest.take_bottom(kTickHeight + 6);
    rest.take_top(8);
    y_ticks = ticks_of(model.y, area.y_range, max_y_ticks);
    rest.take_left(std::max(std::ceil(widest(ui, y_ticks)) + kTickGap, model.least_left));
    rest.take_right(12);
  }
  area.place = {rest.x, rest.y, std::max(1.0f, rest.width), std::max(1.0f, rest.height)};
  if (model.equal_scales) equalise(area);
  if (model.axes) {
    // As many ticks as have room side by side.
    const float tick_width =
        std::max(28.0f, widest(ui, ticks_of(model.x, area.x_range, 4)) + 22);
    const int max_x_ticks = std::clamp(static_cast<int>(rest.width / tick_width), 2, 10);
    draw_y_ticks(ui, area, y_ticks);
    draw_x_ticks(ui, area, ticks_of(model.x, area.x_range, max_x_ticks));
  }
  draw_content(ui, area, model);
  if (model.hover) draw_hover(ui, area, model);
  return area;
}

}  // namespace jnd::app::gui
