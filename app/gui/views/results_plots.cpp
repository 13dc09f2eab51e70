#include "app/gui/views/results_plots.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/gui/views/results_parts.h"

namespace jnd::app::gui {
namespace {

std::string axis_label(const std::string& what, const std::string& quantity) {
  return what + " " + quantity;
}

PlotSeries curve_series(const std::vector<results::Point>& curve, double y_unit) {
  PlotSeries series{.style = PlotSeries::Style::kLine, .thickness = 2.5f};
  for (const results::Point& point : curve) {
    series.x.push_back(point.x);
    series.y.push_back(point.y * y_unit);
  }
  return series;
}

/// Means of magnitudes at intensities, with one standard deviation up and down.
PlotSeries estimation_points(const std::vector<results::Mean>& means) {
  PlotSeries series{
      .style = PlotSeries::Style::kPoints, .colour = Colour::kBlue, .hollow = false};
  for (const results::Mean& mean : means) {
    series.x.push_back(mean.at);
    series.y.push_back(mean.geometric.value_or(mean.arithmetic));
    series.low.push_back(mean.geometric_low.value_or(mean.arithmetic_low));
    series.high.push_back(mean.geometric_high.value_or(mean.arithmetic_high));
  }
  return series;
}

PlotSeries production_points(const std::vector<results::Mean>& means) {
  PlotSeries series{
      .style = PlotSeries::Style::kPoints, .colour = Colour::kAmber, .hollow = false};
  for (const results::Mean& mean : means) {
    series.x.push_back(mean.geometric.value_or(mean.arithmetic));
    series.y.push_back(mean.at);
  }
  return series;
}

/// The spread of intensities that were set lies along x: a line for each mean.
PlotSeries production_spread(const std::vector<results::Mean>& means) {
  PlotSeries series{
      .style = PlotSeries::Style::kLine, .colour = Colour::kAmber, .thickness = 1.5f};
  const double gap = std::numeric_limits<double>::quiet_NaN();
  for (const results::Mean& mean : means) {
    const double low = mean.geometric_low.value_or(mean.arithmetic_low);
    const double high = mean.geometric_high.value_or(mean.arithmetic_high);
    series.x.insert(series.x.end(), {low, high, gap});
    series.y.insert(series.y.end(), {mean.at, mean.at, gap});
  }
  return series;
}

void add_power_curve(PlotModel& plot, const std::optional<results::PowerCurve>& power,
                     const std::string& name, Colour colour, bool dashed) {
  if (!power || power->curve.empty()) return;
  PlotSeries series = curve_series(power->curve, 1.0);
  series.name = name;
  series.colour = colour;
  series.dashed = dashed;
  plot.series.push_back(std::move(series));
}

}  // namespace

PlotSeries answer_points(const std::vector<results::Proportion>& proportions,
                         bool has_fixed_levels) {
  PlotSeries points{.style = PlotSeries::Style::kPoints, .colour = Colour::kInk};
  std::int64_t most = 1;
  for (const results::Proportion& one : proportions) most = std::max(most, one.num_trials);
  for (const results::Proportion& one : proportions) {
    points.x.push_back(one.intensity);
    points.y.push_back(kPercent * one.ratio);
    points.names.push_back(std::to_string(one.num_yes) + " of " +
                           std::to_string(one.num_trials));
    if (has_fixed_levels) {
      points.low.push_back(kPercent * one.low);
      points.high.push_back(kPercent * one.high);
    } else {
      const double share = static_cast<double>(one.num_trials) / static_cast<double>(most);
      points.radii.push_back(1.5f + 5.0f * static_cast<float>(std::sqrt(share)));
    }
  }
  return points;
}

PlotModel psychometric_plot(const results::Discrimination& block,
                            const results::PsychometricFigure& figure) {
  PlotModel plot{.title = block.title, .unit = block.answer + " in percent"};
  plot.x = {
      .label = axis_label("test", block.quantity), .unit = block.unit, .logarithmic = true};
  plot.y = {.minimum = 0.0, .maximum = kPercent};
  for (const int percent : {0, 25, 50, 75, 100}) {
    plot.y.ticks.push_back({static_cast<double>(percent), std::to_string(percent)});
  }
  plot.legend = false;
  if (!figure.band.empty()) {
    PlotSeries band{.style = PlotSeries::Style::kBand};
    for (const results::BandPoint& point : figure.band) {
      band.x.push_back(point.x);
      band.low.push_back(kPercent * point.low);
      band.high.push_back(kPercent * point.high);
    }
    plot.series.push_back(std::move(band));
  }
  if (!figure.pooled_curve.empty()) {
    plot.series.push_back(curve_series(figure.pooled_curve, kPercent));
    plot.series.back().thickness = 1.5f;
    plot.series.back().colour = Colour::kAmber;
    plot.series.back().dashed = true;
  }
  if (!figure.curve.empty()) plot.series.push_back(curve_series(figure.curve, kPercent));
  plot.series.push_back(answer_points(figure.points, block.has_fixed_levels));
  plot.marks.push_back({.at = block.reference});
  // One beyond the stimuli would stretch the axis until nothing else can be seen.
  const double most = figure.curve.empty() ? 0.0 : figure.curve.back().x;
  if (figure.weber_line && *figure.weber_line <= most) {
    constexpr double kAtWeberLine = 84.13;
    plot.marks.push_back({.at = *figure.weber_line,
                          .label = "p (1 + w)",
                          .colour = Colour::kAmber,
                          .dashed = false,
                          .until = kAtWeberLine});
  }
  return plot;
}

PlotModel magnitude_plot(const results::Magnitude& magnitude,
                         const results::MagnitudeFigure& figure) {
  PlotModel plot{.title = magnitude.title, .unit = "magnitude, 100 % being 1"};
  plot.x = {.label = axis_label("intensity,", magnitude.quantity),
            .unit = magnitude.unit,
            .logarithmic = true};
  plot.y = {.logarithmic = true};
  add_power_curve(plot, figure.estimation_curve, "estimation", Colour::kBlue, false);
  add_power_curve(plot, figure.production_curve, "production", Colour::kAmber, false);
  add_power_curve(plot, figure.combined_curve, "combined", Colour::kInk, true);
  if (!figure.estimation.empty()) plot.series.push_back(estimation_points(figure.estimation));
  if (!figure.production.empty()) {
    plot.series.push_back(production_spread(figure.production));
    plot.series.push_back(production_points(figure.production));
  }
  return plot;
}

PlotModel box_plot(const results::BoxFigure& figure) {
  PlotModel plot{.title = figure.title, .unit = figure.unit};
  plot.y.unit = figure.unit;
  for (std::size_t i = 0; i < figure.boxes.size(); ++i) {
    const results::Box& box = figure.boxes[i];
    const auto x = static_cast<double>(i + 1);
    plot.x.ticks.push_back({x, box.label});
    PlotBox drawn{.x = x,
                  .lower_whisker = box.lower_whisker,
                  .lower_quartile = box.lower_quartile,
                  .median = box.median,
                  .upper_quartile = box.upper_quartile,
                  .upper_whisker = box.upper_whisker,
                  .name = box.label};
    for (const results::Box::Outlier& outlier : box.outliers) {
      drawn.outliers.push_back({outlier.value, outlier.participant});
    }
    plot.boxes.push_back(std::move(drawn));
  }
  return plot;
}

}  // namespace jnd::app::gui
