#include "analysis/fits/detection_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/fits/likelihood_profile.h"
#include "analysis/fits/normal_tail.h"
#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {
namespace {

/// k ln p + (n - k) ln q, with 0 ln 0 = 0.
double binomial_log(double k, double n, double p, double q) {
  return (k > 0.0 ? k * std::log(p) : 0.0) + (n > k ? (n - k) * std::log(q) : 0.0);
}
double largest_binomial_log(double k, double n) {
  return n > 0.0 ? binomial_log(k, n, k / n, 1.0 - k / n) : 0.0;
}

/// The data, and minus their log-likelihood as a function of the threshold's place on the
/// abscissa, ln s, and an angle a with g = sin^2 a. The angle lets a rate of 0 lie inside the
/// range of the parameter.
class DetectionModel {
 public:
  explicit DetectionModel(const PsychometricLevels& levels) : levels_(levels) {}

  [[nodiscard]] bool has_catch() const { return levels_.zero_trials > 0.0; }

  bool operator()(std::span<const double> x, double& cost, std::span<double> gradient) const {
    constexpr double kLargestLog = 300.0;
    if (std::fabs(x[1]) > kLargestLog) return false;
    const double spread = std::exp(x[1]);
    const double guess = has_catch() ? std::sin(x[2]) * std::sin(x[2]) : 0.0;
    const double by_angle = has_catch() ? std::sin(2.0 * x[2]) : 0.0;
    std::ranges::fill(gradient, 0.0);
    cost = 0.0;
    double by_guess = 0.0;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const double z = (levels_.abscissa[i] - x[0]) / spread;
      const LogNormalTails tails = log_normal_tails(z);
      const double yes = levels_.num_yes[i];
      const double no = levels_.num_trials[i] - yes;
      const double p = guess + (1.0 - guess) * tails.lower;
      double by_z = -no * tails.mills_upper;
      if (yes > 0.0) {
        // Without guesses the log tail stays finite where p underflows.
        cost -= yes * (guess > 0.0 ? std::log(p) : tails.log_lower);
        by_z += yes * (guess > 0.0 ? (1.0 - guess) * tails.mills_lower * tails.lower / p
                                   : tails.mills_lower);
        by_guess += yes * tails.upper / p;
      }
      if (no > 0.0) {
        cost -= no * (std::log1p(-guess) + tails.log_upper);
        by_guess -= no / (1.0 - guess);
      }
      gradient[0] += by_z / spread;
      gradient[1] += by_z * z;
    }
    if (has_catch()) {
      const double yes = levels_.zero_yes;
      const double no = levels_.zero_trials - yes;
      cost -= binomial_log(yes, yes + no, guess, 1.0 - guess);
      // The derivative of ln sin^2 a by a is 2 cot a, also at a rate of 0.
      double by_own = -no * 2.0 * std::tan(x[2]);
      if (yes > 0.0) by_own += yes * 2.0 / std::tan(x[2]);
      gradient[2] = -(by_own + (std::isfinite(by_guess) ? by_guess * by_angle : 0.0));
    }
    return std::isfinite(cost);
  }

  /// Minus the largest log-likelihood of a step. A step has the rate g below its place, any
  /// rate at it, and only "yes" above it.
  [[nodiscard]] double step_cost() const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t above = 0; above <= levels_.size(); ++above) {
      for (const bool one_at_it : {false, true}) {
        if (one_at_it && above == 0) continue;
        least = std::min(least, cost_of_step(above, one_at_it));
      }
    }
    return least;
  }
  /// Minus the largest log-likelihood of one rate for all stimuli. This rate is at least that
  /// of the catch trials.
  [[nodiscard]] double flat_cost() const {
    double yes = 0.0;
    double trials = 0.0;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      yes += levels_.num_yes[i];
      trials += levels_.num_trials[i];
    }
    const bool more = yes * levels_.zero_trials >= levels_.zero_yes * trials;
    if (!has_catch() || more) {
      return -largest_binomial_log(yes, trials) -
             largest_binomial_log(levels_.zero_yes, levels_.zero_trials);
    }
    return -largest_binomial_log(yes + levels_.zero_yes, trials + levels_.zero_trials);
  }

  /// Starts with the threshold at each level, because a steep curve is best where its threshold
  /// lies on a level.
  [[nodiscard]] std::vector<std::vector<double>> starts() const {
    const double range = levels_.abscissa.back() - levels_.abscissa.front();
    const double rate =
        has_catch() ? (levels_.zero_yes + 0.5) / (levels_.zero_trials + 1.0) : 0.0;
    std::vector<std::vector<double>> all;
    for (const double place : levels_.abscissa) {
      for (const double spread : {0.05, 0.4}) {
        std::vector<double> start = {place, std::log(spread * range)};
        if (has_catch()) start.push_back(std::asin(std::sqrt(rate)));
        all.push_back(std::move(start));
      }
    }
    return all;
  }

 private:
  [[nodiscard]] double cost_of_step(std::size_t above, bool one_at_it) const {
    double low_yes = levels_.zero_yes;
    double low_trials = levels_.zero_trials;
    double cost = 0.0;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      if (one_at_it && i + 1 == above) {
        cost -= largest_binomial_log(levels_.num_yes[i], levels_.num_trials[i]);
      } else if (i < above) {
        low_yes += levels_.num_yes[i];
        low_trials += levels_.num_trials[i];
      } else if (levels_.num_yes[i] < levels_.num_trials[i]) {
        return std::numeric_limits<double>::infinity();
      }
    }
    if (!has_catch() && low_yes > 0.0) return std::numeric_limits<double>::infinity();
    return cost - largest_binomial_log(low_yes, low_trials);
  }

  const PsychometricLevels& levels_;
};

std::string why_degenerate(const DetectionModel& model, double cost) {
  constexpr double kNoGain = 1e-8;
  if (model.step_cost() <= cost + kNoGain) {
    return "separated: one threshold splits the answers without overlap, so how fast they "
           "rise, and where between two levels, they do not say";
  }
  if (model.flat_cost() <= cost + kNoGain) {
    return "flat: \"yes\" does not become more frequent with the intensity";
  }
  return "";
}

}  // namespace

DetectionFit fit_detection(const std::vector<AnswerCount>& data) {
  // The search covers every quotient of levels, and ends where a curve is a step or a flat
  // line.
  constexpr double kFarthestPlace = 50.0;
  constexpr double kFarthestLog = 12.0;
  DetectionFit fit{.status = FitStatus::kDegenerate};
  double largest = 0.0;
  for (const AnswerCount& row : data) largest = std::max(largest, row.intensity);
  if (!(largest > 0.0)) {
    fit.reason = "not identified: no answers to a stimulus";
    return fit;
  }
  const PsychometricLevels levels = pooled_levels(data, largest, /*free_pse=*/true);
  if (levels.size() < 2) {
    fit.reason = "not identified: fewer than two intensities with answers";
    return fit;
  }
  const DetectionModel model(levels);
  const SmoothCost cost = [&model](std::span<const double> x, double& value,
                                   std::span<double> gradient) {
    return model(x, value, gradient);
  };
  const std::vector<std::vector<double>> starts = model.starts();
  const LikelihoodOptimum optimum = likelihood_optimum(cost, starts);
  fit.reason = why_degenerate(model, optimum.cost);
  if (!fit.reason.empty()) return fit;
  if (!optimum.converged) {
    fit.status = FitStatus::kNotConverged;
    fit.reason = "the search for the optimum did not come to rest";
    return fit;
  }
  fit.status = FitStatus::kOk;
  const auto intensity = [&](double place) { return levels.intensity_at(place); };
  const auto spread = [&](double log) { return std::exp(log) * levels.unit; };
  const auto ends = [](const Interval& ci95, const auto& value) {
    return Interval{ci95.low ? std::optional(value(*ci95.low)) : std::nullopt,
                    ci95.high ? std::optional(value(*ci95.high)) : std::nullopt};
  };
  fit.threshold = intensity(optimum.at[0]);
  fit.spread_ln = spread(optimum.at[1]);
  fit.false_alarm_rate = model.has_catch() ? std::pow(std::sin(optimum.at[2]), 2) : 0.0;
  fit.log_likelihood = -optimum.cost;
  fit.threshold_ci95 =
      ends(likelihood_ratio_interval(cost, optimum, starts, 0, kFarthestPlace), intensity);
  fit.spread_ln_ci95 =
      ends(likelihood_ratio_interval(cost, optimum, starts, 1, kFarthestLog), spread);
  return fit;
}

}  // namespace jnd::analysis
