#include "analysis/mixed/mixed_curves.h"

#include <algorithm>
#include <map>

namespace jnd::analysis {
namespace {

constexpr std::size_t kMostPoints = 24;

/// The answers at each stimulus. If there are many stimuli, neighbours are pooled.
std::vector<CurvePoint> points_of(const std::map<double, CurvePoint>& by_stimulus) {
  double num_trials = 0.0;
  for (const auto& [stimulus, point] : by_stimulus) num_trials += point.num_trials;
  const double fewest =
      by_stimulus.size() <= kMostPoints ? 0.0 : num_trials / static_cast<double>(kMostPoints);
  std::vector<CurvePoint> points;
  for (const auto& [stimulus, point] : by_stimulus) {
    if (points.empty() || points.back().num_trials >= std::max(fewest, 1e-300)) {
      points.emplace_back();
    }
    CurvePoint& last = points.back();
    const double together = last.num_trials + point.num_trials;
    last.intensity += (stimulus - last.intensity) * point.num_trials / together;
    last.num_yes += point.num_yes;
    last.num_trials = together;
  }
  return points;
}

/// For each row, the index of its cell in the lines.
std::vector<std::size_t> cells_of_rows(const StimulusLines& lines, const Design& design,
                                       const TrialTable& table) {
  std::map<std::vector<double>, std::size_t> places;
  for (std::size_t i = 0; i < lines.cells.size(); ++i) places[lines.cells[i].levels] = i;
  std::vector<std::size_t> cells(table.num_rows());
  for (std::size_t row = 0; row < cells.size(); ++row) {
    std::vector<double> levels;
    for (const CodedVariable& variable : design.variables()) {
      if (!variable.is_factor) continue;
      levels.push_back(variable.value_of_cell[table.find(variable.column)->place[row]]);
    }
    cells[row] = places.at(levels);
  }
  return cells;
}

}  // namespace

std::vector<CellCurve> cell_curves(const StimulusLines& lines, const Design& design,
                                   const TrialTable& table, const std::string& stimulus,
                                   const MixedFit& fit,
                                   const std::vector<DerivedQuantity>& derived) {
  const std::vector<std::size_t> cells = cells_of_rows(lines, design, table);
  const TrialVariable& column = *table.find(stimulus);
  std::vector<std::map<double, CurvePoint>> answers(lines.cells.size());
  for (std::size_t row = 0; row < cells.size(); ++row) {
    if (!(table.num_trials[row] > 0.0)) continue;
    CurvePoint& point = answers[cells[row]][column.number(row)];
    point.num_yes += table.num_yes[row];
    point.num_trials += table.num_trials[row];
  }
  const Eigen::VectorXd beta = fit.estimates();
  std::vector<CellCurve> curves;
  for (std::size_t i = 0; i < lines.cells.size(); ++i) {
    const MixedCell& cell = lines.cells[i];
    CellCurve curve{.name = cell.name,
                    .points = points_of(answers[i]),
                    .offset = cell.offset.dot(beta),
                    .slope = cell.slope.dot(beta)};
    const std::string pse = "PSE" + (cell.name.empty() ? "" : ", " + cell.name);
    const auto quantity = std::ranges::find(derived, pse, &DerivedQuantity::name);
    if (quantity != derived.end()) {
      curve.pse = quantity->value;
      curve.pse_ci95 = quantity->ci95;
    }
    curves.push_back(std::move(curve));
  }
  return curves;
}

}  // namespace jnd::analysis
