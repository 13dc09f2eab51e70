#include <algorithm>
#include <cmath>

#include "analysis/report/magnitude_data.h"
#include "analysis/results/report_words.h"

namespace jnd::analysis {
namespace {

/// Means of both methods, and the ends of what was measured by each.
struct Measured {
  MagnitudeData data;
  FigureTable means;
  AxisRange range{0.0, 0.0};
};

Measured measured(const FigureSource& source, const BlockDesign& block) {
  Measured result{.data = magnitude_data(source, block)};
  result.means = group_means_table(result.data);
  bool first = true;
  for (const auto& row : result.means.rows) {
    const double intensity = row[0].number.value_or(0.0);
    result.range.low = first ? intensity : std::min(result.range.low, intensity);
    result.range.high = first ? intensity : std::max(result.range.high, intensity);
    first = false;
  }
  return result;
}

/// The smallest means above 0, where logarithmic axes begin.
struct Least {
  double x = 0.0, y = 0.0;
};
Least least_of(const std::vector<const FigureTable*>& tables) {
  Least least;
  const auto take = [](double& smallest, const FigureCell& cell) {
    const double value = cell.number.value_or(0.0);
    if (value > 0.0 && (smallest == 0.0 || value < smallest)) smallest = value;
  };
  for (const FigureTable* const table : tables) {
    for (const auto& row : table->rows) {
      if (row[0].number.value_or(0.0) > 0.0) take(least.y, row[1]);
      take(least.x, row[0]);
    }
  }
  return {least.x > 0.0 ? least.x : 0.1, least.y > 0.0 ? least.y : 0.1};
}

/// A curve within what was measured, and dotted beyond.
std::string curve_commands(const FigureTable& curve, const std::string& type,
                           const std::string& title) {
  const auto part = [&](int extrapolated) {
    return from_table(curve) +
           "'intensity':(column('extrapolated')==" + std::to_string(extrapolated) +
           " ? column('magnitude') : NaN) with lines lt " + type;
  };
  return part(1) + " lw 1 dt (1,3), " + part(0) + " lw 2" +
         (title.empty() ? "" : " title " + gnuplot_quoted(title));
}

std::string law_title(const FigureSource& source, const std::string& name,
                      const std::string& estimate) {
  const Estimate* const k = source.results.find(estimate + ".k");
  const Estimate* const a = source.results.find(estimate + ".a");
  if (k == nullptr || a == nullptr || !k->value || !a->value) return name + ": none";
  return name + ": k = " + number_words(k->value, 3) + ", a = " + number_words(a->value, 3);
}

const BlockDesign* only_block(const StudyData& data, bool (BlockDesign::*measure)() const) {
  const BlockDesign* found = nullptr;
  for (const BlockDesign& block : data.blocks) {
    if (!(block.*measure)()) continue;
    if (found != nullptr) return nullptr;
    found = &block;
  }
  return found;
}

}  // namespace

std::vector<Figure> power_law_figures(const FigureSource& source) {
  const BlockDesign* const estimation = only_block(source.data, &BlockDesign::estimates);
  const BlockDesign* const production = only_block(source.data, &BlockDesign::produces);
  if (estimation == nullptr || production == nullptr) return {};
  const Measured estimated = measured(source, *estimation);
  const Measured produced = measured(source, *production);
  if (estimated.means.rows.empty() || produced.means.rows.empty()) return {};
  const double most = std::max(estimated.range.high, produced.range.high);
  if (!(most > 0.0)) return {};
  const AxisRange shown{most / 200.0, 1.05 * most};
  FigureTable first = power_curve_table("power_law_estimation", source, estimation->block,
                                        shown, estimated.range);
  FigureTable second = power_curve_table("power_law_production", source, production->block,
                                         shown, produced.range);
  FigureTable both =
      power_curve_table("power_law_combined", source, "combined", shown,
                        {std::min(estimated.range.low, produced.range.low), most});
  if (first.rows.empty() && second.rows.empty()) return {};
  const Least least = least_of({&estimated.means, &produced.means});
  Figure figure{.name = "power_laws",
                .section = "combined",
                .title = "Estimation, production and the law between them",
                .caption =
                    "Power laws through the means of estimation and of production, and "
                    "the one between both curves, on linear (left) and logarithmic axes "
                    "(right). Marks: means over participants. Dotted: beyond the "
                    "intensities that were measured.",
                .thesis = "Fig. 4c, D.4 and D.15",
                .height_in = 3.7};
  PanelGrid grid{.num_columns = 2,
                 .x_title = quantity_axis(estimation->quantity),
                 .y_title = "Perceived magnitude (modulus = 1)",
                 .top_in = 0.62,
                 .gap_x_in = 0.55};
  const auto curves = [&](bool with_titles) {
    std::string plot = "plot ";
    const auto add = [&](const FigureTable& curve, const std::string& type,
                         const std::string& name, const std::string& estimate) {
      if (curve.rows.empty()) return;
      plot +=
          curve_commands(curve, type, with_titles ? law_title(source, name, estimate) : "") +
          ", ";
    };
    add(first, "1", "estimation", estimation->block);
    add(second, "2", "production", production->block);
    add(both, "5", "between", "combined");
    return plot + from_table(estimated.means) +
           "'intensity':'magnitude' with points lt 1 ps 0.7, " + from_table(produced.means) +
           "'intensity':'magnitude' with points lt 2 ps 0.8";
  };
  const std::string key =
      "  set key at screen 0.5,0.99 center top vertical reverse Left samplen 3 font small\n";
  figure.plot = grid_plot(
      grid,
      {{.title = "",
        .before = key + "  set xrange " + range_words({-0.02 * shown.high, shown.high}) +
                  "\n  set yrange [0:*]\n",
        .plot = curves(true)},
       {.title = "",
        .before = "  set logscale xy\n  set xrange " +
                  range_words({least.x / 1.6, 1.15 * most}) + "\n  set yrange [" +
                  plot_number(least.y / 1.6) +
                  ":*]\n  set xtics (0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)\n"
                  "  set ytics (0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50, 100)\n",
        .plot = curves(false)}},
      figure.width_in, figure.height_in);
  figure.tables = {std::move(first), std::move(second), std::move(both), estimated.means,
                   produced.means};
  return {std::move(figure)};
}

}  // namespace jnd::analysis
