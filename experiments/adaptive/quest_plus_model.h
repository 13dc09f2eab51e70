#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace jnd::experiments {

/// A normal distribution of ln of the parameter.
struct LogNormalPrior {
  double median = 1.0;  ///< > 0, in the unit of the parameter.
  double sd_ln = 1.0;   ///< > 0.
};

/// The values that a parameter may have, and their probabilities before the first answer.
struct ParameterGrid {
  std::vector<double> values;  ///< One or more, ascending. A single value is a known parameter.
  /// Evaluated at each value, which must be > 0. Without it, all values are equally likely.
  std::optional<LogNormalPrior> prior;
};

/// Grids of p(x) = lapse + (1 - 2 lapse) Phi( ln(x / pse) / ln(1 + weber_fraction) ), the curve
/// of core::PsychometricFunction.
struct WeberGrids {
  ParameterGrid pse;                    ///< > 0, in the unit of the intensity.
  ParameterGrid weber_fraction;         ///< > 0.
  ParameterGrid lapse_rate = {{0.02}};  ///< [0, 0.5).
};

/// Grids of p(x) = guess + (1 - guess - lapse) F(x; threshold, slope).
struct ThresholdGrids {
  ParameterGrid threshold;             ///< > 0, in the unit of the intensity.
  ParameterGrid slope;                 ///< > 0, for each unit of ln.
  ParameterGrid guess_rate = {{0.5}};  ///< [0, 1).
  /// [0, 1); guess rate and lapse rate together are below 1.
  ParameterGrid lapse_rate = {{0.02}};
};

struct QuestPlusParameter {
  std::string name;
  ParameterGrid grid;
  bool is_ratio = false;  ///< Means and standard deviations are taken in ln.
};

/// A psychometric function with its grids, for QUEST+.
struct QuestPlusModel {
  std::vector<QuestPlusParameter> parameters;
  /// Returns the probability of the answer at an intensity >= 0, for parameters in this order.
  std::function<double(bool yes, double intensity, std::span<const double> values)> probability;
};

/// Throws `Error` naming the parameter whose grid or prior is wrong.
void require_model(const QuestPlusModel& model);

/// Returns the probability of each combination before the first answer. The parameters are
/// independent, and the last one runs fastest.
[[nodiscard]] Eigen::VectorXd prior_of(const QuestPlusModel& model);

/// Each of these throws `Error` naming the parameter that has a value out of range. Not real
/// time.
[[nodiscard]] QuestPlusModel weber_model(const WeberGrids& grids);
/// F = Phi( slope ln(x / threshold) ), which is 0.5 at the threshold.
[[nodiscard]] QuestPlusModel gauss_model(const ThresholdGrids& grids);
/// The curve of right answers in a task with several intervals. With d = |ln(x / reference)|, F
/// = Phi( slope ln(d / ln(1 + weber_fraction)) ), which is 0.5 at reference (1 +
/// weber_fraction). `grids.threshold` holds this Weber fraction, after which the parameter is
/// named.
[[nodiscard]] QuestPlusModel identification_model(const ThresholdGrids& grids,
                                                  double reference);
/// F = 1 - exp( -(x / threshold)^slope ) (Weibull 1951), which is 1 - 1/e at the threshold.
[[nodiscard]] QuestPlusModel weibull_model(const ThresholdGrids& grids);

}  // namespace jnd::experiments
