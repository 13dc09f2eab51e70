#include "analysis/report/power_law_figure.h"

#include <algorithm>
#include <cmath>

#include "analysis/charts/axis_range.h"
#include "analysis/report/plot_parts.h"
#include "analysis/words/said.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostLawsTogether = 6, kMostLawPanels = 48;
constexpr int kNumLawPoints = 201;

double law_at(const DrawnPowerLaw& law, double intensity) {
  const double above = intensity - law.intensity_threshold;
  if (!(above > 0.0)) return NAN;
  return law.magnitude_offset + *law.k * std::pow(above, *law.a);
}

/// The range of both axes. Logarithmic axes show only values above 0.
struct LawAxes {
  bool are_logarithmic = true;
  AxisRange intensity, magnitude;
};

LawAxes axes_of(const std::vector<DrawnPowerLaw>& laws) {
  std::vector<double> intensities, magnitudes;
  bool all_above = true;
  for (const DrawnPowerLaw& law : laws) {
    for (const Magnitude& row : law.rows) {
      intensities.push_back(row.intensity);
      magnitudes.push_back(row.magnitude);
      all_above &= row.magnitude >= 0.0;
    }
  }
  const auto is_above = [](double value) { return value > 0.0; };
  LawAxes axes;
  axes.are_logarithmic = all_above && std::ranges::any_of(magnitudes, is_above) &&
                         std::ranges::any_of(intensities, is_above);
  axes.intensity = axis_range(intensities, axes.are_logarithmic);
  axes.magnitude = axis_range(magnitudes, axes.are_logarithmic);
  return axes;
}

FigureTable magnitudes_table(const std::vector<DrawnPowerLaw>& laws) {
  FigureTable table{.name = "magnitudes",
                    .columns = {"series", "group", "intensity", "magnitude"}};
  for (std::size_t i = 0; i < laws.size(); ++i) {
    for (const Magnitude& row : laws[i].rows) {
      table.rows.push_back(
          {static_cast<int>(i) + 1, laws[i].name, row.intensity, row.magnitude});
    }
  }
  return table;
}

FigureTable laws_table(const std::vector<DrawnPowerLaw>& laws, const LawAxes& axes) {
  FigureTable table{.name = "laws", .columns = {"series", "intensity", "magnitude"}};
  const AxisRange& range = axes.intensity;
  for (std::size_t i = 0; i < laws.size(); ++i) {
    if (!laws[i].k || !laws[i].a) continue;
    for (int point = 0; point < kNumLawPoints; ++point) {
      const double share = static_cast<double>(point) / (kNumLawPoints - 1);
      const double x = axes.are_logarithmic
                           ? range.low * std::pow(range.high / range.low, share)
                           : range.low + share * (range.high - range.low);
      const double y = law_at(laws[i], x);
      if (std::isfinite(y)) table.rows.push_back({static_cast<int>(i) + 1, x, y});
    }
  }
  return table;
}

std::string axis_commands(const LawAxes& axes, bool small) {
  std::string text = "  set xrange " + range_words(axes.intensity) + "\n  set yrange " +
                     range_words(axes.magnitude) + "\n";
  if (axes.are_logarithmic) {
    return text + "  set logscale xy\n" + log_tics("x", axes.intensity, small) +
           log_tics("y", axes.magnitude, small);
  }
  return text +
         (small ? small_tics("x", axes.intensity) + small_tics("y", axes.magnitude) : "");
}

std::string law_commands(const std::vector<FigureTable>& tables, int series, int colour,
                         const std::string& title, bool small) {
  const std::string type = " lt " + std::to_string(colour) + " dt 1";
  const std::string magnitude = "'intensity':" + if_series(series, "magnitude");
  return from_table(tables[1]) + magnitude + " with lines" + type +
         (small ? " lw 1.4" : " lw 2") +
         (title.empty() ? "" : " title " + gnuplot_quoted(title)) + ", " +
         from_table(tables[0]) + magnitude + " with points" + type + " pt 6 ps " +
         (small ? "0.4" : "0.7");
}

std::string title_of_law(const DrawnPowerLaw& law) {
  return law.name + (law.k ? "" : said(" (no law)"));
}

}  // namespace

Figure power_law_figure(const std::vector<DrawnPowerLaw>& laws) {
  const std::vector<DrawnPowerLaw> shown(
      laws.begin(),
      laws.begin() + static_cast<std::ptrdiff_t>(std::min(laws.size(), kMostLawPanels)));
  if (std::ranges::all_of(shown, [](const DrawnPowerLaw& law) { return law.rows.empty(); })) {
    throw core::Error("expected magnitudes to draw, found none");
  }
  const LawAxes axes = axes_of(shown);
  Figure figure{.name = "power_law",
                .section = "power_law",
                .title = said("Power laws"),
                .caption = said("Magnitudes, and the power laws that are fitted to them.")};
  figure.tables = {magnitudes_table(shown), laws_table(shown, axes)};
  if (shown.size() <= kMostLawsTogether) {
    figure.width_in = 5.2;
    figure.height_in = 3.7;
    const bool has_key = shown.size() > 1 || !shown.front().name.empty();
    if (has_key) {
      figure.height_in += 0.2 * std::ceil(static_cast<double>(shown.size()) / 2.0);
      figure.plot = "  set key outside above left horizontal reverse Left font small\n";
    }
    figure.plot += "  set xlabel " + gnuplot_quoted(said("Intensity")) + "\n  set ylabel " +
                   gnuplot_quoted(said("Magnitude")) + "\n" +
                   axis_commands(axes, /*small=*/false) + "  plot ";
    for (std::size_t i = 0; i < shown.size(); ++i) {
      const int series = static_cast<int>(i) + 1;
      figure.plot +=
          (i == 0 ? "" : ", ") + law_commands(figure.tables, series, series,
                                              has_key ? title_of_law(shown[i]) : "", false);
    }
    figure.plot += "\n";
    return figure;
  }
  const PanelGrid grid{
      .num_columns = 4, .x_title = said("Intensity"), .y_title = said("Magnitude")};
  std::vector<Panel> panels;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    panels.push_back(
        {.title = title_of_law(shown[i]),
         .before = axis_commands(axes, /*small=*/true),
         .plot = "plot " + law_commands(figure.tables, static_cast<int>(i) + 1, 1, "", true)});
  }
  figure.width_in = 6.6;
  figure.height_in = grid_height_in(grid, panels.size(), 1.2);
  figure.plot = grid_plot(grid, panels, figure.width_in, figure.height_in);
  return figure;
}

}  // namespace jnd::analysis
