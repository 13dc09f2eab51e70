#include "analysis/mixed/mixed_derived.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <set>

#include "analysis/statistics/distributions.h"
#include "analysis/statistics/summary.h"

namespace jnd::analysis {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr std::array<const char*, 3> kQuantities = {"PSE", "JND", "Weber fraction"};

/// The indices of two cells. The difference is the first minus the second.
using CellPair = std::pair<std::size_t, std::size_t>;

/// Every two cells that differ in one factor only: the later one minus the earlier one.
std::vector<CellPair> compared_cells(const std::vector<MixedCell>& cells) {
  std::vector<CellPair> pairs;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t j = i + 1; j < cells.size(); ++j) {
      int num_different = 0;
      for (std::size_t k = 0; k < cells[i].levels.size(); ++k) {
        num_different += cells[i].levels[k] != cells[j].levels[k] ? 1 : 0;
      }
      if (num_different == 1) pairs.emplace_back(j, i);
    }
  }
  return pairs;
}

/// Whether f(2 s) - f(s) = f(s) - f(0) in every column.
bool is_straight(const Eigen::VectorXd& first, const Eigen::VectorXd& second,
                 const Eigen::VectorXd& third) {
  const Eigen::VectorXd bend = third - 2.0 * second + first;
  const double size = first.norm() + second.norm() + third.norm();
  return bend.norm() <= 1e-9 * size;
}

/// Computes rows of the design for given levels and stimuli, with other covariates at their
/// means over the trials.
class CellRows {
 public:
  CellRows(const Design& design, const TrialTable& table, const std::string& stimulus)
      : design_(design), stimulus_(stimulus) {
    for (const CodedVariable& variable : design.variables()) {
      if (variable.is_factor || variable.column == stimulus) {
        values_.push_back(0.0);
        continue;
      }
      const TrialVariable& column = *table.find(variable.column);
      double sum = 0.0, num_trials = 0.0;
      for (std::size_t row = 0; row < column.place.size(); ++row) {
        sum += table.num_trials[row] * variable.value_of_cell[column.place[row]];
        num_trials += table.num_trials[row];
      }
      values_.push_back(sum / num_trials);
    }
  }

  /// The design's row in this cell at this stimulus.
  [[nodiscard]] Eigen::VectorXd at(const std::vector<double>& levels, double stimulus) {
    std::size_t factor = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const CodedVariable& variable = design_.variables()[i];
      if (variable.is_factor) {
        values_[i] = levels[factor++];
      } else if (variable.column == stimulus_) {
        values_[i] = variable.transformed(stimulus);
      }
    }
    return design_.row(values_);
  }

 private:
  const Design& design_;
  const std::string& stimulus_;
  std::vector<double> values_;
};

/// The three quantities of one cell, with their gradients by beta. Values that do not exist are
/// NaN.
struct CellQuantities {
  std::array<double, 3> value = {kNone, kNone, kNone};
  std::array<Eigen::VectorXd, 3> gradient;
  bool is_jnd_below = false;  ///< Whether F is `jnd_at` at a stimulus below the PSE.
};

CellQuantities quantities_of(const MixedCell& cell, const StimulusLines& lines, MixedLink link,
                             double jnd_at, const Eigen::VectorXd& beta) {
  CellQuantities found;
  const double a = cell.offset.dot(beta), b = cell.slope.dot(beta);
  for (Eigen::VectorXd& one : found.gradient) one = Eigen::VectorXd::Zero(beta.size());
  if (b == 0.0 || !std::isfinite(a) || !std::isfinite(b)) return found;
  const double middle = link_quantile(link, 0.5);
  // The stimulus where F is `jnd_at` is this much further on the axis than the PSE.
  const double step = (link_quantile(link, jnd_at) - middle) / b;
  const double place = (middle - a) / b, width = std::fabs(step);
  const Eigen::VectorXd by_place = -(cell.offset + place * cell.slope) / b;
  const Eigen::VectorXd by_width = -(width / b) * cell.slope;
  const bool is_log = lines.axis == StimulusAxis::kLogarithmic;
  const double pse = is_log ? std::exp(place) : place;
  const Eigen::VectorXd by_pse = is_log ? Eigen::VectorXd(pse * by_place) : by_place;
  const double weber = is_log ? std::fabs(std::expm1(step)) : width / pse;
  const Eigen::VectorXd by_weber =
      is_log ? Eigen::VectorXd(std::exp(step) * by_width)
             : Eigen::VectorXd(by_width / pse - (weber / pse) * by_place);
  found.is_jnd_below = step < 0.0;
  found.value = {pse, is_log ? pse * weber : width,
                 lines.has_weber_fraction && pse > 0.0 ? weber : kNone};
  found.gradient = {
      by_pse, is_log ? Eigen::VectorXd(weber * by_pse + pse * by_weber) : by_width, by_weber};
  return found;
}

/// The interval of a value by its logarithm, where `reach` is that of the value itself.
Interval by_logarithm(double value, double reach) {
  return {value * std::exp(-reach / value), value * std::exp(reach / value)};
}

/// The interval of a Weber fraction on a logarithmic axis, by the logarithm of the step on the
/// axis. A stimulus below the PSE is above 0, so that the fraction of one is below 1.
Interval by_step(double weber, double reach, bool is_below) {
  const double ratio = is_below ? 1.0 - weber : 1.0 + weber;
  const Interval step = by_logarithm(std::fabs(std::log(ratio)), reach / ratio);
  const auto fraction = [is_below](double of_step) {
    return is_below ? -std::expm1(-of_step) : std::expm1(of_step);
  };
  return {fraction(*step.low), fraction(*step.high)};
}

/// The interval between the expanded percentiles of sorted values, if so many redraws beside
/// these had no value. Those may lie beyond either end.
Interval percentiles(const std::vector<double>& sorted, std::size_t num_without,
                     std::size_t num_groups) {
  const std::size_t num_redraws = sorted.size() + num_without;
  const std::optional<std::size_t> needed = num_redraws_needed(num_groups);
  if (!needed || num_redraws < *needed) return {};
  const double place = expanded_tail(num_groups) * static_cast<double>(num_redraws - 1);
  const double below = place - static_cast<double>(num_without);
  if (!(below >= 0.0)) return {};
  const double share = below / static_cast<double>(sorted.size() - 1);
  return {percentile(sorted, share), percentile(sorted, 1.0 - share)};
}

}  // namespace

StimulusLines stimulus_lines(const Formula& formula, const Design& design,
                             const TrialTable& table, const std::string& stimulus) {
  StimulusLines lines;
  const auto place = std::ranges::find(formula.variables, stimulus, &FormulaVariable::column);
  if (place == formula.variables.end()) {
    throw FormulaError(
        "expected the stimulus " + stimulus + " in the formula, found none of it", formula.text,
        formula.text.size());
  }
  std::set<std::vector<double>> levels;
  std::vector<std::size_t> factors;
  for (std::size_t i = 0; i < design.variables().size(); ++i) {
    const CodedVariable& variable = design.variables()[i];
    if (variable.is_factor && variable.column == stimulus) {
      throw FormulaError("expected a stimulus of numbers, found the factor " + variable.name,
                         formula.text, formula.variables[i].at);
    }
    if (variable.is_factor) factors.push_back(i);
    if (!variable.is_factor && variable.column != stimulus) lines.held.push_back(variable.name);
  }
  for (std::size_t row = 0; row < table.num_rows(); ++row) {
    std::vector<double> of_row;
    for (const std::size_t i : factors) {
      const CodedVariable& variable = design.variables()[i];
      of_row.push_back(variable.value_of_cell[table.find(variable.column)->place[row]]);
    }
    levels.insert(std::move(of_row));
  }
  const std::vector<double>& numbers = table.find(stimulus)->numbers;
  const bool is_positive = std::ranges::all_of(numbers, [](double x) { return x > 0.0; });
  const double scale =
      std::fabs(*std::ranges::max_element(numbers, {}, [](double x) { return std::fabs(x); }));
  CellRows rows(design, table, stimulus);
  const auto is_linear = [&] {
    return std::ranges::all_of(levels, [&](const std::vector<double>& cell) {
      const Eigen::VectorXd at_none = rows.at(cell, 0.0);
      return at_none.allFinite() &&
             is_straight(at_none, rows.at(cell, scale), rows.at(cell, 2.0 * scale));
    });
  };
  const auto is_logarithmic = [&] {
    return is_positive && std::ranges::all_of(levels, [&](const std::vector<double>& cell) {
             return is_straight(rows.at(cell, 1.0), rows.at(cell, std::exp(1.0)),
                                rows.at(cell, std::exp(2.0)));
           });
  };
  if (!is_linear()) {
    if (!is_logarithmic()) {
      throw FormulaError("expected the stimulus as " + stimulus + " alone or log(" + stimulus +
                             ") alone, so that it has a PSE, found it otherwise",
                         formula.text, place->at);
    }
    lines.axis = StimulusAxis::kLogarithmic;
  }
  lines.has_weber_fraction = is_positive;
  const bool is_log = lines.axis == StimulusAxis::kLogarithmic;
  for (const std::vector<double>& of_cell : levels) {
    MixedCell cell{.name = {}, .levels = of_cell, .offset = {}, .slope = {}};
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const CodedVariable& variable = design.variables()[factors[i]];
      cell.name += (i == 0 ? "" : ", ") + variable.name + " " +
                   variable.levels[static_cast<std::size_t>(of_cell[i])];
    }
    const double from = is_log ? 1.0 : 0.0, to = is_log ? std::exp(1.0) : scale;
    cell.offset = rows.at(of_cell, from);
    cell.slope = (rows.at(of_cell, to) - cell.offset) / (is_log ? 1.0 : scale);
    lines.cells.push_back(std::move(cell));
  }
  return lines;
}

std::vector<double> derived_values(const StimulusLines& lines, MixedLink link, double jnd_at,
                                   const Eigen::VectorXd& beta) {
  std::vector<CellQuantities> cells;
  std::vector<double> values;
  for (const MixedCell& cell : lines.cells) {
    cells.push_back(quantities_of(cell, lines, link, jnd_at, beta));
    values.insert(values.end(), cells.back().value.begin(), cells.back().value.end());
  }
  for (const auto& [later, earlier] : compared_cells(lines.cells)) {
    for (std::size_t k = 0; k < kQuantities.size(); ++k) {
      values.push_back(cells[later].value[k] - cells[earlier].value[k]);
    }
  }
  return values;
}

std::optional<std::size_t> num_redraws_needed(std::size_t num_groups) {
  if (num_groups < kFewestResampled) return std::nullopt;
  return static_cast<std::size_t>(std::ceil(1.0 / expanded_tail(num_groups)));
}

std::vector<DerivedQuantity> derived_quantities(const StimulusLines& lines, MixedLink link,
                                                double jnd_at, const Eigen::VectorXd& beta,
                                                const MixedUncertainty& uncertainty) {
  std::vector<DerivedQuantity> all;
  const double student_t =
      student_t_quantile(0.975, static_cast<double>(uncertainty.num_groups) - 1.0);
  const auto add = [&](const std::string& name, double value, const Eigen::VectorXd& gradient,
                       const std::function<Interval(double value, double reach)>& interval) {
    DerivedQuantity quantity{.name = name};
    if (std::isfinite(value)) {
      const double error = std::sqrt(gradient.dot(uncertainty.covariance * gradient));
      quantity.value = value;
      quantity.standard_error = error;
      quantity.ci95 = interval(value, student_t * error);
    }
    all.push_back(std::move(quantity));
  };
  const auto about = [](double value, double reach) {
    return Interval{value - reach, value + reach};
  };
  const bool is_log = lines.axis == StimulusAxis::kLogarithmic;
  std::vector<CellQuantities> cells;
  for (const MixedCell& cell : lines.cells) {
    cells.push_back(quantities_of(cell, lines, link, jnd_at, beta));
    const CellQuantities& its = cells.back();
    const std::string of_cell = cell.name.empty() ? "" : ", " + cell.name;
    const auto of_step = [&its](double value, double reach) {
      return by_step(value, reach, its.is_jnd_below);
    };
    const auto add_next = [&](std::size_t k, const auto& interval) {
      add(kQuantities[k] + of_cell, its.value[k], its.gradient[k], interval);
    };
    if (is_log) {
      add_next(0, by_logarithm);
      add_next(1, by_logarithm);
      add_next(2, of_step);
    } else {
      add_next(0, about);
      add_next(1, by_logarithm);
      add_next(2, by_logarithm);
    }
  }
  for (const auto& [later, earlier] : compared_cells(lines.cells)) {
    for (std::size_t k = 0; k < kQuantities.size(); ++k) {
      add(std::string(kQuantities[k]) + ", " + lines.cells[later].name + " - " +
              lines.cells[earlier].name,
          cells[later].value[k] - cells[earlier].value[k],
          cells[later].gradient[k] - cells[earlier].gradient[k], about);
    }
  }
  std::vector<std::vector<double>> drawn(all.size());
  for (const Eigen::VectorXd& one : uncertainty.redrawn) {
    if (one.size() == 0) continue;
    const std::vector<double> values = derived_values(lines, link, jnd_at, one);
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (std::isfinite(values[i])) drawn[i].push_back(values[i]);
    }
  }
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i].value || drawn[i].empty()) continue;
    std::ranges::sort(drawn[i]);
    all[i].bootstrap_ci95 = percentiles(drawn[i], uncertainty.redrawn.size() - drawn[i].size(),
                                        uncertainty.num_groups);
  }
  // A Weber fraction that no cell has is not reported.
  std::erase_if(all, [&](const DerivedQuantity& one) {
    return !lines.has_weber_fraction && one.name.starts_with(kQuantities[2]);
  });
  return all;
}

}  // namespace jnd::analysis
