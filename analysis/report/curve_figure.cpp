#include "analysis/report/curve_figure.h"

#include <algorithm>
#include <cmath>

#include "analysis/report/plot_parts.h"
#include "analysis/statistics/wilson_interval.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostTogether = 6, kMostPanels = 48;
constexpr int kNumCurvePoints = 201;
/// Below so many answers a point, bars say nothing but that they are few.
constexpr double kFewestForBars = 3.0;

bool has_curve(const CurveFit& fit) { return fit.status == FitStatus::kOk; }

AxisRange intensity_range(const std::vector<CurveFit>& fits, bool logarithmic) {
  std::vector<double> intensities;
  for (const CurveFit& fit : fits) {
    for (const CurvePoint& point : fit.points) {
      if (point.intensity > 0.0 || !logarithmic) intensities.push_back(point.intensity);
    }
  }
  AxisRange range = axis_range(intensities, logarithmic);
  if (logarithmic && !intensities.empty()) {
    // Close around the levels: a power of ten may be far off.
    const auto [least, most] = std::ranges::minmax(intensities);
    const double air = std::pow(most / least, 0.06);
    range = {least / std::max(air, 1.02), most * std::max(air, 1.02)};
  }
  return range;
}

FigureTable answers_table(const std::vector<CurveFit>& fits) {
  FigureTable table{.name = "answers",
                    .columns = {"series", "intensity", "proportion", "low", "high", "trials"}};
  for (std::size_t i = 0; i < fits.size(); ++i) {
    for (const CurvePoint& point : fits[i].points) {
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

FigureTable curves_table(const std::vector<CurveFit>& fits, const AxisRange& range,
                         bool logarithmic) {
  FigureTable table{.name = "curves", .columns = {"series", "intensity", "proportion"}};
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!has_curve(fits[i])) continue;
    for (int point = 0; point < kNumCurvePoints; ++point) {
      const double share = static_cast<double>(point) / (kNumCurvePoints - 1);
      const double x = logarithmic ? range.low * std::pow(range.high / range.low, share)
                                   : range.low + share * (range.high - range.low);
      table.rows.push_back({static_cast<int>(i) + 1, x, fits[i].probability(x)});
    }
  }
  return table;
}

FigureTable thresholds_table(const std::vector<CurveFit>& fits, const AxisRange& range) {
  FigureTable table{.name = "thresholds",
                    .columns = {"series", "at", "intensity", "proportion", "low", "high"}};
  for (std::size_t i = 0; i < fits.size(); ++i) {
    if (!has_curve(fits[i])) continue;
    for (const CurveThreshold& one : fits[i].thresholds) {
      const double x = one.intensity.value.value_or(NAN);
      if (!(x >= range.low && x <= range.high)) continue;
      const auto within = [&](const std::optional<double>& end, double open) {
        return std::clamp(end.value_or(open), range.low, range.high);
      };
      table.rows.push_back({static_cast<int>(i) + 1, one.at, x, one.proportion,
                            within(one.intensity.ci95.low, range.low),
                            within(one.intensity.ci95.high, range.high)});
    }
  }
  return table;
}

/// What one series draws.
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

std::string axes_of(const std::vector<CurveFit>& fits, const AxisRange& range, bool logarithmic,
                    bool small) {
  std::string text = "  set xrange " + range_words(range) + "\n  set yrange [-0.03:1.03]\n" +
                     "  set ytics 0,0.25,1" + (small ? " font small" : "") + "\n";
  if (logarithmic) {
    text += "  set logscale x\n" + log_tics("x", range, small);
  } else if (small) {
    text += small_tics("x", range);
  }
  text += "  set bars 0\n";
  const double guess = fits.front().guess_rate.value.value_or(0.0);
  if (guess > 0.0 && !fits.front().model.free_guess) {
    text += "  set arrow 1 from graph 0,first " + plot_number(guess) + " to graph 1,first " +
            plot_number(guess) + " nohead ls 12\n";
  }
  return text;
}

}  // namespace

Figure curve_figure(const std::vector<std::string>& names, const std::vector<CurveFit>& fits,
                    const std::string& intensity_name, const std::string& answer_name) {
  const std::vector<CurveFit> shown(
      fits.begin(),
      fits.begin() + static_cast<std::ptrdiff_t>(std::min(fits.size(), kMostPanels)));
  const bool logarithmic = shown.front().model.is_logarithmic();
  const AxisRange range = intensity_range(shown, logarithmic);
  Figure figure{.name = "psychometric",
                .section = "psychometric",
                .title = "Psychometric functions",
                .caption = "Answers, the fitted curves, and their thresholds with 95 %."};
  figure.tables = {answers_table(shown), curves_table(shown, range, logarithmic),
                   thresholds_table(shown, range)};
  const double most_trials = largest_in(figure.tables[0], "trials");
  const bool right = shown.front().guess_rate.value.value_or(0.0) > 0.0;
  const std::string y_title = answer_name.empty() || answer_name == "num_yes"
                                  ? (right ? "Proportion right" : "Proportion yes")
                                  : "Proportion of " + answer_name;
  if (shown.size() <= kMostTogether) {
    figure.width_in = 5.2;
    figure.height_in = 3.7;
    const bool has_key = shown.size() > 1 || !names.front().empty();
    if (has_key) {
      figure.height_in += 0.2 * std::ceil(static_cast<double>(shown.size()) / 2.0);
      figure.plot = "  set key outside above left horizontal reverse Left font small\n";
    }
    figure.plot += "  set xlabel " + gnuplot_quoted(intensity_name) + "\n  set ylabel " +
                   gnuplot_quoted(y_title) + "\n" +
                   axes_of(shown, range, logarithmic, /*small=*/false) + "  plot ";
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const int series = static_cast<int>(i) + 1;
      const std::string title =
          has_key ? names[i] + (has_curve(shown[i]) ? "" : " (no curve)") : "";
      figure.plot += (i == 0 ? "" : ", ") +
                     series_commands(figure.tables, series, series, title, most_trials, false);
    }
    figure.plot += "\n";
    return figure;
  }
  PanelGrid grid{.num_columns = 4, .x_title = intensity_name, .y_title = y_title};
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    panels.push_back({.title = names[i] + (has_curve(shown[i]) ? "" : " (no curve)"),
                      .before = axes_of(shown, range, logarithmic, /*small=*/true),
                      .plot = "plot " + series_commands(figure.tables, static_cast<int>(i) + 1,
                                                        1, "", most_trials, true)});
  }
  figure.width_in = 6.6;
  figure.height_in = grid_height_in(grid, panels.size(), 1.1);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  return figure;
}

}  // namespace jnd::analysis
