#include "analysis/fits/interval_order_fit.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "analysis/fits/answer_scatter.h"
#include "analysis/fits/calibrated_drop.h"
#include "analysis/fits/likelihood_profile.h"
#include "analysis/fits/normal_tail.h"
#include "analysis/fits/probit_regression.h"
#include "core/psychometric_function.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace {

/// The answers at one intensity in one order.
struct Cell {
  double log_ratio = 0.0;  ///< ln(x / reference)
  double order = 0.0, num_yes = 0.0, num_trials = 0.0;
};
using Cells = std::vector<Cell>;

Cells cells_of(const std::vector<AnswerCount>& data, double reference) {
  std::map<std::pair<double, double>, Cell> pooled;
  for (const AnswerCount& row : data) {
    if (row.num_trials == 0 || row.intensity == 0.0) continue;
    Cell& cell = pooled[{row.intensity, row.order}];
    cell.log_ratio = std::log(row.intensity / reference);
    cell.order = row.order;
    cell.num_yes += static_cast<double>(row.num_yes);
    cell.num_trials += static_cast<double>(row.num_trials);
  }
  Cells cells;
  for (const auto& [key, cell] : pooled) cells.push_back(cell);
  return cells;
}

/// The columns are ln(x / reference), the order, and 1 if the pse is free.
Eigen::MatrixXd design_of(const Cells& cells, bool free_pse) {
  const auto size = static_cast<Eigen::Index>(cells.size());
  Eigen::MatrixXd design = Eigen::MatrixXd::Ones(size, free_pse ? 3 : 2);
  for (Eigen::Index row = 0; row < size; ++row) {
    design(row, 0) = cells[static_cast<std::size_t>(row)].log_ratio;
    design(row, 1) = cells[static_cast<std::size_t>(row)].order;
  }
  return design;
}

Eigen::VectorXd counts_of(const Cells& cells, double Cell::*count) {
  Eigen::VectorXd counts(static_cast<Eigen::Index>(cells.size()));
  for (Eigen::Index row = 0; row < counts.size(); ++row) {
    counts(row) = cells[static_cast<std::size_t>(row)].*count;
  }
  return counts;
}

ProbitRegression regression_of(const Cells& cells, bool free_pse) {
  return fit_probit(design_of(cells, free_pse), counts_of(cells, &Cell::num_yes),
                    counts_of(cells, &Cell::num_trials));
}

/// x ln(share), or 0 for a count of 0.
double log_term(double count, double share) {
  return count > 0.0 ? count * std::log(share) : 0.0;
}

/// Twice the log-likelihood that the saturated model, which gives each cell its own proportion,
/// gains.
double deviance_of(const Cells& cells, double log_likelihood) {
  double saturated = 0.0;
  for (const Cell& cell : cells) {
    const double share = cell.num_yes / cell.num_trials;
    saturated +=
        log_term(cell.num_yes, share) + log_term(cell.num_trials - cell.num_yes, 1.0 - share);
  }
  return std::max(0.0, 2.0 * (saturated - log_likelihood));
}

/// Minus the log-likelihood as a function of ln slope, order effect and ln(pse / reference).
/// The last one is absent if the pse is held at the reference.
SmoothCost cost_of(const Cells& cells) {
  return [&cells](std::span<const double> x, double& value, std::span<double> gradient) {
    const double slope = std::exp(x[0]);
    value = 0.0;
    std::ranges::fill(gradient, 0.0);
    for (const Cell& cell : cells) {
      const double place = x[1] * cell.order + (x.size() > 2 ? x[2] : 0.0);
      const double z = slope * (cell.log_ratio - place);
      const LogNormalTails tails = log_normal_tails(z);
      const double no = cell.num_trials - cell.num_yes;
      if (cell.num_yes > 0.0) value -= cell.num_yes * tails.log_lower;
      if (no > 0.0) value -= no * tails.log_upper;
      const double by_z = no * tails.mills_upper - cell.num_yes * tails.mills_lower;
      gradient[0] += by_z * z;
      gradient[1] -= by_z * slope * cell.order;
      if (x.size() > 2) gradient[2] -= by_z * slope;
    }
    return std::isfinite(value);
  };
}

void add_intervals(PsychometricFit& fit, const Cells& cells, const LikelihoodOptimum& optimum,
                   const CalibratedDrops& drops, double reference) {
  constexpr double kFarthestLog = 12.0;
  const SmoothCost cost = cost_of(cells);
  const auto interval = [&](std::size_t parameter, double drop) {
    return likelihood_ratio_interval(cost, optimum, {}, parameter, kFarthestLog, drop);
  };
  const auto fraction_at = [](double log_slope) -> std::optional<double> {
    const double fraction = std::expm1(std::exp(-log_slope));
    return std::isfinite(fraction) ? std::optional(fraction) : std::nullopt;
  };
  const Interval log_slope = interval(0, drops.slope);
  if (log_slope.high) fit.weber_fraction_ci95.low = fraction_at(*log_slope.high);
  if (log_slope.low) fit.weber_fraction_ci95.high = fraction_at(*log_slope.low);
  if (optimum.at.size() < 3) return;
  const Interval place = interval(2, drops.pse);
  fit.pse_ci95 = Interval{};
  if (place.low) fit.pse_ci95->low = reference * std::exp(*place.low);
  if (place.high) fit.pse_ci95->high = reference * std::exp(*place.high);
}

/// The cells, each with the fitted curve's probability of a yes.
std::vector<FittedAnswers> fitted_answers(const Cells& cells,
                                          const LikelihoodOptimum& optimum) {
  std::vector<FittedAnswers> answers;
  for (const Cell& cell : cells) {
    const double pse = optimum.at.size() > 2 ? optimum.at[2] : 0.0;
    const double z =
        std::exp(optimum.at[0]) * (cell.log_ratio - (optimum.at[1] * cell.order + pse));
    answers.push_back({cell.num_yes, cell.num_trials, normal_tails(z).lower});
  }
  return answers;
}

/// Computes how often answers that are redrawn from the fitted curve and refitted lie at least
/// as far from their curve. Separated redraws count with the limit of their likelihood.
void add_goodness(PsychometricFit& fit, const Cells& cells, const LikelihoodOptimum& optimum,
                  const PsychometricOptions& options) {
  const bool free_pse = optimum.at.size() > 2;
  fit.goodness.degrees_of_freedom =
      static_cast<int>(cells.size()) - static_cast<int>(optimum.at.size());
  if (options.num_goodness == 0) return;
  const std::vector<FittedAnswers> fitted = fitted_answers(cells, optimum);
  core::RandomStream random(options.seed, "goodness of fit by interval order");
  Cells redrawn = cells;
  int num_as_far = 0;
  for (int draw = 0; draw < options.num_goodness; ++draw) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      redrawn[i].num_yes = 0.0;
      for (double trial = 0.0; trial < cells[i].num_trials; trial += 1.0) {
        redrawn[i].num_yes += random.uniform() < fitted[i].probability ? 1.0 : 0.0;
      }
    }
    const double log_likelihood = regression_of(redrawn, free_pse).log_likelihood;
    // With few answers ties are common, and rounding must not break them.
    if (deviance_of(redrawn, log_likelihood) >= *fit.deviance * (1.0 - 1e-9)) ++num_as_far;
  }
  fit.goodness.n = options.num_goodness;
  fit.goodness.p_value = (1.0 + num_as_far) / (1.0 + options.num_goodness);
}

/// The order whose answers are all alike, if this holds for exactly one order.
std::optional<double> order_all_alike(const Cells& cells) {
  std::optional<double> found;
  for (const double order : {kTestFirst, kTestSecond}) {
    const auto is_other = [&](const Cell& cell) { return cell.order != order; };
    const bool alike =
        std::ranges::all_of(
            cells, [&](const Cell& cell) { return is_other(cell) || cell.num_yes == 0.0; }) ||
        std::ranges::all_of(cells, [&](const Cell& cell) {
          return is_other(cell) || cell.num_yes == cell.num_trials;
        });
    if (!alike) continue;
    if (found) return std::nullopt;
    found = order;
  }
  return found;
}

/// Fits the other order alone. With a free pse, an order whose answers are all alike is best
/// explained by an infinite order effect, and tells nothing about the slope. The slope is then
/// that of the other order with a free place. Neither the pse nor the order effect has a value.
PsychometricFit fit_of_other_order(const std::vector<AnswerCount>& data, double alike,
                                   const PsychometricOptions& options) {
  std::vector<AnswerCount> rows;
  for (const AnswerCount& row : data) {
    if (row.order != alike) rows.push_back(row);
  }
  PsychometricOptions alone = options;
  alone.by_order = false;
  PsychometricFit fit = fit_psychometric(rows, alone);
  if (fit.status != FitStatus::kOk) return fit;
  fit.pse.reset();
  fit.pse_ci95 = Interval{};
  fit.warnings.push_back(std::string("with the test ") +
                         (alike == kTestFirst ? "first" : "second") +
                         " every answer is the same: the Weber fraction is that of the other "
                         "order, and the order effect has no value");
  return fit;
}

}  // namespace

bool orders_vary(const std::vector<AnswerCount>& data) noexcept {
  std::optional<double> first;
  for (const AnswerCount& row : data) {
    if (row.num_trials == 0) continue;
    if (first && *first != row.order) return true;
    first = row.order;
  }
  return false;
}

PsychometricFit fit_by_interval_order(const std::vector<AnswerCount>& data,
                                      const PsychometricOptions& options) {
  const Cells cells = cells_of(data, options.reference);
  PsychometricFit fit;
  fit.num_levels = static_cast<int>(cells.size());
  for (const AnswerCount& row : data) fit.num_trials += row.num_trials;
  fit.status = FitStatus::kDegenerate;
  if (std::ranges::any_of(data, [](const AnswerCount& row) {
        return row.intensity == 0.0 && row.num_yes > 0;
      })) {
    fit.reason = "impossible: a yes at intensity 0 has probability 0 without lapses";
    return fit;
  }
  const ProbitRegression found = regression_of(cells, options.free_pse);
  fit.reason = found.reason;
  fit.is_separated = found.is_separated;
  if (found.status != FitStatus::kOk) {
    const std::optional<double> alike =
        options.free_pse ? order_all_alike(cells) : std::nullopt;
    return alike ? fit_of_other_order(data, *alike, options) : fit;
  }
  const double slope = found.coefficients(0);
  const double fraction = std::expm1(1.0 / slope);
  if (!(slope > 0.0 && std::isfinite(fraction))) {
    fit.reason = "flat or inverted: the test is not chosen more often as it grows";
    return fit;
  }
  LikelihoodOptimum optimum{.at = {std::log(slope), -found.coefficients(1) / slope},
                            .cost = -found.log_likelihood,
                            .converged = true};
  if (options.free_pse) optimum.at.push_back(-found.coefficients(2) / slope);
  fit.pse = options.reference * std::exp(options.free_pse ? optimum.at[2] : 0.0);
  if (!(std::isfinite(*fit.pse) && *fit.pse > 0.0)) {
    fit.pse.reset();
    fit.reason = "flat: the answers rise so little that the values exceed the range of numbers";
    return fit;
  }
  fit.status = FitStatus::kOk;
  fit.weber_fraction = fraction;
  fit.order_effect_ln = optimum.at[1];
  fit.lapse_rate = 0.0;
  fit.standard_error =
      std::exp(1.0 / slope) / (slope * slope) * std::sqrt(found.covariance(0, 0));
  fit.log_likelihood = found.log_likelihood;
  fit.deviance = deviance_of(cells, found.log_likelihood);
  if (options.intervals) {
    CalibratedDrops drops;
    if (options.num_calibration > 0) {
      drops = calibrated_drops(design_of(cells, options.free_pse),
                               counts_of(cells, &Cell::num_trials), found.coefficients,
                               options.free_pse, options.num_calibration, options.seed);
      fit.calibration = {options.num_calibration, drops.slope, drops.pse};
    }
    add_intervals(fit, cells, optimum, drops, options.reference);
    fit.misfit_p_value =
        misfit_p_value(fitted_answers(cells, optimum), static_cast<double>(optimum.at.size()));
  }
  if (options.diagnostics) add_goodness(fit, cells, optimum, options);
  return fit;
}

double mean_over_orders(double pse, double weber_fraction, double order_effect_ln,
                        double intensity) noexcept {
  const auto at = [&](double order) {
    if (!(weber_fraction > 0.0)) {
      const double place = pse * std::exp(order * order_effect_ln);
      return intensity < place ? 0.0 : intensity > place ? 1.0 : 0.5;
    }
    return core::PsychometricFunction{.pse = pse * std::exp(order * order_effect_ln),
                                      .weber_fraction = weber_fraction}
        .probability(intensity);
  };
  return 0.5 * (at(kTestFirst) + at(kTestSecond));
}

}  // namespace jnd::analysis
