#include "analysis/report/curve_figure.h"

#include <algorithm>
#include <cmath>

#include "analysis/charts/axis_range.h"
#include "analysis/report/plot_parts.h"
#include "analysis/statistics/wilson_interval.h"
#include "analysis/words/said.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostTogether = 6, kMostPanels = 48;
constexpr int kNumCurvePoints = 201;
/// With fewer answers for each point, bars would only show that they are few.
constexpr double kFewestForBars = 3.0;

AxisRange intensity_range(const std::vector<DrawnCurve>& curves, bool logarithmic) {
  std::vector<double> intensities;
  for (const DrawnCurve& curve : curves) {
    for (const CurvePoint& point : curve.points) {
      if (point.intensity > 0.0 || !logarithmic) intensities.push_back(point.intensity);
    }
  }
  AxisRange range = axis_range(intensities, logarithmic);
  if (logarithmic && !intensities.empty()) {
    // The range lies close around the levels, because the next power of ten may be far off.
    const auto [least, most] = std::ranges::minmax(intensities);
    const double air = std::pow(most / least, 0.06);
    range = {least / std::max(air, 1.02), most * std::max(air, 1.02)};
  }
  return range;
}

FigureTable answers_table(const std::vector<DrawnCurve>& curves) {
  FigureTable table{.name = "answers",
                    .columns = {"series", "intensity", "proportion", "low", "high", "trials"}};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const CurvePoint& point : curves[i].points) {
      const auto [low, high] = wilson_interval(static_cast<std::int64_t>(point.num_yes),
                                               static_cast<std::int64_t>(point.num_trials));
      const double share = point.num_yes / point.num_trials;
      const bool bars = point.num_trials >= kFewestForBars;
      table.rows.push_back({static_cast<int>(i) + 1, point.intensity, share, bars ? low : share,
                            bars ? high : share, point.num_trials});
    }
  }
  return table;
}

FigureTable curves_table(const std::vector<DrawnCurve>& curves, const AxisRange& range,
                         bool logarithmic) {
  FigureTable table{.name = "curves", .columns = {"series", "intensity", "proportion"}};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (!curves[i].probability) continue;
    for (int point = 0; point < kNumCurvePoints; ++point) {
      const double share = static_cast<double>(point) / (kNumCurvePoints - 1);
      const double x = logarithmic ? range.low * std::pow(range.high / range.low, share)
                                   : range.low + share * (range.high - range.low);
      table.rows.push_back({static_cast<int>(i) + 1, x, curves[i].probability(x)});
    }
  }
  return table;
}

FigureTable thresholds_table(const std::vector<DrawnCurve>& curves, const AxisRange& range) {
  FigureTable table{.name = "thresholds",
                    .columns = {"series", "at", "intensity", "proportion", "low", "high"}};
  for (std::size_t i = 0; i < curves.size(); ++i) {
    for (const DrawnThreshold& one : curves[i].thresholds) {
      if (!(one.intensity >= range.low && one.intensity <= range.high)) continue;
      const auto within = [&](const std::optional<double>& end, double open) {
        return std::clamp(end.value_or(open), range.low, range.high);
      };
      table.rows.push_back({static_cast<int>(i) + 1, one.at, one.intensity, one.proportion,
                            within(one.ci95.low, range.low),
                            within(one.ci95.high, range.high)});
    }
  }
  return table;
}

/// The plot commands of one series.
std::string series_commands(const std::vector<FigureTable>& tables, int series, int colour,
                            const std::string& title, double most_trials, bool small) {
  const std::string type = " lt " + std::to_string(colour) + " dt 1";
  const auto column = [&](const char* name) { return if_series(series, name); };
  const std::string size = "(" + std::string(small ? "0.15" : "0.3") + "+" +
                           (small ? "0.6" : "1.1") + "*sqrt(column('trials')/" +
                           plot_number(std::max(most_trials, 1.0)) + "))";
  const std::string& answers = from_table(tables[0]);
  return answers + "'intensity':" + column("proportion") + ":'low':'high' with yerrorbars" +
         type + " lw 0.8 ps 0, " + from_table(tables[1]) +
         "'intensity':" + column("proportion") + " with lines" + type +
         (small ? " lw 1.4" : " lw 2") +
         (title.empty() ? "" : " title " + gnuplot_quoted(title)) + ", " + answers +
         "'intensity':" + column("proportion") + ":" + size + " with points" + type +
         " pt 7 ps variable, " + from_table(tables[2]) + "'intensity':" + column("proportion") +
         ":'low':'high' with xerrorbars" + type + (small ? " lw 1.2" : " lw 1.8") + " ps 0";
}

std::string axes_of(const CurveAxes& axes, const AxisRange& range, bool small) {
  std::string text = "  set xrange " + range_words(range) + "\n  set yrange [-0.03:1.03]\n" +
                     "  set ytics 0,0.25,1" + (small ? " font small" : "") + "\n";
  if (axes.logarithmic) {
    text += "  set logscale x\n" + log_tics("x", range, small);
  } else if (small) {
    text += small_tics("x", range);
  }
  text += "  set bars 0\n";
  if (axes.guess_rate > 0.0) {
    text += "  set arrow 1 from graph 0,first " + plot_number(axes.guess_rate) +
            " to graph 1,first " + plot_number(axes.guess_rate) + " nohead ls 12\n";
  }
  return text;
}

std::string title_of(const DrawnCurve& curve) {
  return curve.name + (curve.probability ? "" : said(" (no curve)"));
}

DrawnCurve drawn(const std::string& name, const CurveFit& fit) {
  DrawnCurve curve{.name = name, .points = fit.points};
  if (fit.status != FitStatus::kOk) return curve;
  curve.probability = [fit](double intensity) { return fit.probability(intensity); };
  for (const CurveThreshold& one : fit.thresholds) {
    if (!one.intensity.value) continue;
    curve.thresholds.push_back({.at = one.at,
                                .intensity = *one.intensity.value,
                                .proportion = one.proportion,
                                .ci95 = one.intensity.ci95});
  }
  return curve;
}

}  // namespace

Figure curve_figure(const std::vector<DrawnCurve>& curves, const CurveAxes& axes) {
  const std::vector<DrawnCurve> shown(
      curves.begin(),
      curves.begin() + static_cast<std::ptrdiff_t>(std::min(curves.size(), kMostPanels)));
  if (std::ranges::all_of(shown, [](const DrawnCurve& one) { return one.points.empty(); })) {
    throw core::Error("expected answers to draw, found none");
  }
  const AxisRange range = intensity_range(shown, axes.logarithmic);
  Figure figure{.name = "psychometric",
                .section = "psychometric",
                .title = said("Psychometric functions"),
                .caption = said("Answers, the fitted curves, and their thresholds with 95 %.")};
  figure.tables = {answers_table(shown), curves_table(shown, range, axes.logarithmic),
                   thresholds_table(shown, range)};
  const double most_trials = largest_in(figure.tables[0], "trials");
  if (shown.size() <= kMostTogether) {
    figure.width_in = 5.2;
    figure.height_in = 3.7;
    const bool has_key = shown.size() > 1 || !shown.front().name.empty();
    if (has_key) {
      figure.height_in += 0.2 * std::ceil(static_cast<double>(shown.size()) / 2.0);
      figure.plot = "  set key outside above left horizontal reverse Left font small\n";
    }
    figure.plot += "  set xlabel " + gnuplot_quoted(axes.intensity_name) + "\n  set ylabel " +
                   gnuplot_quoted(axes.answer_name) + "\n" +
                   axes_of(axes, range, /*small=*/false) + "  plot ";
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const int series = static_cast<int>(i) + 1;
      figure.plot += (i == 0 ? "" : ", ") + series_commands(figure.tables, series, series,
                                                            has_key ? title_of(shown[i]) : "",
                                                            most_trials, false);
    }
    figure.plot += "\n";
    return figure;
  }
  PanelGrid grid{.num_columns = 4, .x_title = axes.intensity_name, .y_title = axes.answer_name};
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    panels.push_back({.title = title_of(shown[i]),
                      .before = axes_of(axes, range, /*small=*/true),
                      .plot = "plot " + series_commands(figure.tables, static_cast<int>(i) + 1,
                                                        1, "", most_trials, true)});
  }
  figure.width_in = 6.6;
  figure.height_in = grid_height_in(grid, panels.size(), 1.1);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  return figure;
}

Figure curve_figure(const std::vector<std::string>& names, const std::vector<CurveFit>& fits,
                    const std::string& intensity_name, const std::string& answer_name) {
  std::vector<DrawnCurve> curves;
  for (std::size_t i = 0; i < fits.size(); ++i) curves.push_back(drawn(names[i], fits[i]));
  const double guess = fits.front().guess_rate.value.value_or(0.0);
  const std::string y_title =
      answer_name.empty() || answer_name == "num_yes"
          ? (guess > 0.0 ? said("Proportion right") : said("Proportion yes"))
          : said("Proportion of {}", answer_name);
  return curve_figure(curves, {.intensity_name = intensity_name,
                               .answer_name = y_title,
                               .logarithmic = fits.front().model.is_logarithmic(),
                               .guess_rate = fits.front().model.free_guess ? 0.0 : guess});
}

}  // namespace jnd::analysis
