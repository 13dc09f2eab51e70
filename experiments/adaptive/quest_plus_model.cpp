#include "experiments/adaptive/quest_plus_model.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/psychometric_function.h"
#include "core/require.h"
#include "experiments/adaptive/level_scale.h"

namespace jnd::experiments {
namespace {

using core::require;

QuestPlusParameter ratio(std::string name, const ParameterGrid& grid) {
  for (const double value : grid.values) {
    require(value > 0.0 && std::isfinite(value), "quest_plus." + name, "values > 0", value);
  }
  return {std::move(name), grid, true};
}

QuestPlusParameter rate(std::string name, const ParameterGrid& grid, double below) {
  for (const double value : grid.values) {
    require(value >= 0.0 && value < below, "quest_plus." + name,
            below == 0.5 ? "values in [0, 0.5)" : "values in [0, 1)", value);
  }
  return {std::move(name), grid, false};
}

std::vector<QuestPlusParameter> parameters_of(const ThresholdGrids& grids) {
  std::vector<QuestPlusParameter> parameters = {
      ratio("threshold", grids.threshold), ratio("slope", grids.slope),
      rate("guess_rate", grids.guess_rate, 1.0), rate("lapse_rate", grids.lapse_rate, 1.0)};
  for (const double guess : grids.guess_rate.values) {
    for (const double lapse : grids.lapse_rate.values) {
      require(guess + lapse < 1.0, "quest_plus.guess_rate",
              "guess and lapse rate together below 1", guess + lapse);
    }
  }
  return parameters;
}

/// `tail` is F for "yes" and 1 - F for "no", so that small values of either keep their
/// precision.
double with_rates(bool yes, double tail, double guess, double lapse) noexcept {
  return (yes ? guess : lapse) + (1.0 - guess - lapse) * tail;
}

/// Returns the weights of a grid's values, which sum to 1.
std::vector<double> weights_of(const QuestPlusParameter& parameter) {
  const ParameterGrid& grid = parameter.grid;
  std::vector<double> log_weights(grid.values.size(), 0.0);
  if (grid.prior) {
    for (std::size_t i = 0; i < grid.values.size(); ++i) {
      const double z = std::log(grid.values[i] / grid.prior->median) / grid.prior->sd_ln;
      log_weights[i] = -0.5 * z * z;
    }
  }
  // The largest weight is factored out, so that a prior far off the grid does not underflow to
  // zero everywhere.
  const double largest = *std::max_element(log_weights.begin(), log_weights.end());
  double sum = 0.0;
  std::vector<double> weights;
  for (const double log_weight : log_weights) {
    weights.push_back(std::exp(log_weight - largest));
    sum += weights.back();
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

}  // namespace

void require_model(const QuestPlusModel& model) {
  require(!model.parameters.empty(), "quest_plus.parameters", "one or more", 0.0);
  for (const auto& [name, grid, is_ratio] : model.parameters) {
    const std::string place = "quest_plus." + name;
    require(!grid.values.empty(), place, "one value or more", 0.0);
    const bool positive = is_ratio || grid.prior;
    require_ascending(positive ? LevelScale::kLogarithmic : LevelScale::kLinear, place,
                      grid.values);
    if (!grid.prior) continue;
    require_level(LevelScale::kLogarithmic, place + ".median", grid.prior->median);
    require_level(LevelScale::kLogarithmic, place + ".sd_ln", grid.prior->sd_ln);
  }
}

Eigen::VectorXd prior_of(const QuestPlusModel& model) {
  Eigen::VectorXd prior = Eigen::VectorXd::Ones(1);
  for (const QuestPlusParameter& parameter : model.parameters) {
    const std::vector<double> weights = weights_of(parameter);
    const auto num_values = static_cast<Eigen::Index>(weights.size());
    Eigen::VectorXd extended(prior.size() * num_values);
    for (Eigen::Index i = 0; i < extended.size(); ++i) {
      extended[i] = prior[i / num_values] * weights[i % num_values];
    }
    prior = std::move(extended);
  }
  return prior;
}

QuestPlusModel weber_model(const WeberGrids& grids) {
  return {{ratio("pse", grids.pse), ratio("weber_fraction", grids.weber_fraction),
           rate("lapse_rate", grids.lapse_rate, 0.5)},
          [](bool yes, double intensity, std::span<const double> values) {
            const double z = std::log(intensity / values[0]) / std::log1p(values[1]);
            return with_rates(yes, core::standard_normal_cdf(yes ? z : -z), values[2],
                              values[2]);
          }};
}

QuestPlusModel gauss_model(const ThresholdGrids& grids) {
  return {parameters_of(grids), [](bool yes, double intensity, std::span<const double> values) {
            const double z = values[1] * std::log(intensity / values[0]);
            return with_rates(yes, core::standard_normal_cdf(yes ? z : -z), values[2],
                              values[3]);
          }};
}

QuestPlusModel identification_model(const ThresholdGrids& grids, double reference) {
  require(reference > 0.0, "quest_plus.reference", "a number > 0", reference);
  QuestPlusModel model{
      parameters_of(grids),
      [reference](bool yes, double intensity, std::span<const double> values) {
        const double distance = std::abs(std::log(intensity / reference));
        const double z = values[1] * std::log(distance / std::log1p(values[0]));
        return with_rates(yes, core::standard_normal_cdf(yes ? z : -z), values[2], values[3]);
      }};
  model.parameters.front().name = "weber_fraction";
  return model;
}

QuestPlusModel weibull_model(const ThresholdGrids& grids) {
  return {parameters_of(grids), [](bool yes, double intensity, std::span<const double> values) {
            const double decay = -std::pow(intensity / values[0], values[1]);
            return with_rates(yes, yes ? -std::expm1(decay) : std::exp(decay), values[2],
                              values[3]);
          }};
}

}  // namespace jnd::experiments
