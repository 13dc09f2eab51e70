#include "analysis/fits/same_different_fit.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "analysis/fits/likelihood_profile.h"
#include "analysis/fits/normal_tail.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

/// The answers to one size of difference, in either direction.
struct Pairs {
  double num_different = 0.0, num_trials = 0.0;
};
/// The answers by |ln(x / reference)|.
using Differences = std::map<double, Pairs>;

Differences differences_of(const std::vector<AnswerCount>& data, double reference) {
  core::require(reference > 0.0, "reference", "an intensity > 0", reference);
  // Quotients that are each other's inverse, apart from rounding, are one difference.
  constexpr double kRounding = 1e-9;
  Differences differences;
  for (const AnswerCount& row : data) {
    core::require(row.intensity > 0.0 && std::isfinite(row.intensity), "intensity",
                  "an intensity > 0", row.intensity);
    core::require(row.num_yes >= 0 && row.num_yes <= row.num_trials, "num_yes",
                  "0 to the number of trials", static_cast<double>(row.num_yes));
    if (row.num_trials == 0) continue;
    double size = std::fabs(std::log(row.intensity / reference));
    const auto near = differences.lower_bound(size - kRounding);
    if (near != differences.end() && near->first <= size + kRounding) size = near->first;
    Pairs& pairs = differences[size];
    pairs.num_different += static_cast<double>(row.num_yes);
    pairs.num_trials += static_cast<double>(row.num_trials);
  }
  return differences;
}

/// Minus the log-likelihood as a function of (ln s, ln (k / s)).
bool cost_at(const Differences& differences, std::span<const double> x, double& cost,
             std::span<double> gradient) {
  constexpr double kLargestLog = 300.0;
  if (std::fabs(x[0]) > kLargestLog || std::fabs(x[1]) > kLargestLog) return false;
  const double spread = std::exp(x[0]);
  const double criterion = std::exp(x[1]);
  std::ranges::fill(gradient, 0.0);
  cost = 0.0;
  for (const auto& [size, pairs] : differences) {
    const double d = size / spread;
    const NormalTails over = normal_tails(-criterion + d);
    const NormalTails under = normal_tails(-criterion - d);
    const double p = over.lower + under.lower;
    const double q = over.upper - under.lower;  // q is Phi(k - d) - Phi(-k - d).
    const double yes = pairs.num_different;
    const double no = pairs.num_trials - yes;
    if ((yes > 0.0 && !(p > 0.0)) || (no > 0.0 && !(q > 0.0))) return false;
    if (yes > 0.0) cost -= yes * std::log(p);
    if (no > 0.0) cost -= no * std::log(q);
    const double by_p = (yes > 0.0 ? yes / p : 0.0) - (no > 0.0 ? no / q : 0.0);
    gradient[0] += by_p * (over.density - under.density) * d;
    gradient[1] += by_p * (over.density + under.density) * criterion;
  }
  return std::isfinite(cost);
}

double largest_binomial_log(const Pairs& pairs) {
  const double k = pairs.num_different;
  const double n = pairs.num_trials;
  return (k > 0.0 ? k * std::log(k / n) : 0.0) +
         (n > k ? (n - k) * std::log(1.0 - k / n) : 0.0);
}

/// Whether nobody said "different" below some size and everybody did above it. At that size any
/// rate may occur.
bool is_separated(const Differences& differences) {
  auto at = differences.begin();
  while (at != differences.end() && at->second.num_different == 0.0) ++at;
  if (at != differences.end()) ++at;
  return std::all_of(at, differences.end(), [](const auto& one) {
    return one.second.num_different == one.second.num_trials;
  });
}

std::string why_degenerate(const Differences& differences) {
  if (differences.size() < 2) {
    return "not identified: fewer than two sizes of difference with answers";
  }
  Pairs all;
  for (const auto& [size, pairs] : differences) {
    all.num_different += pairs.num_different;
    all.num_trials += pairs.num_trials;
  }
  if (all.num_different == 0.0) return "all alike: \"different\" was never said";
  if (all.num_different == all.num_trials) return "all alike: \"same\" was never said";
  if (is_separated(differences)) {
    return "separated: one size of difference splits the answers without overlap";
  }
  return "";
}

/// Minus the largest log-likelihood of one rate for all differences.
double flat_cost(const Differences& differences) {
  Pairs all;
  for (const auto& [size, pairs] : differences) {
    all.num_different += pairs.num_different;
    all.num_trials += pairs.num_trials;
  }
  return -largest_binomial_log(all);
}

std::vector<std::vector<double>> starts(const Differences& differences) {
  const double largest = differences.rbegin()->first;
  std::vector<std::vector<double>> all;
  for (const double spread : {0.15, 0.5, 1.5}) {
    for (const double criterion : {0.5, 1.5}) {
      all.push_back({std::log(spread * largest), std::log(criterion)});
    }
  }
  return all;
}

}  // namespace

SameDifferentFit fit_same_different(const std::vector<AnswerCount>& data, double reference) {
  constexpr double kNoGain = 1e-8;
  constexpr double kFarthestLog = 12.0;
  const Differences differences = differences_of(data, reference);
  SameDifferentFit fit{.status = FitStatus::kDegenerate, .reason = why_degenerate(differences)};
  if (!fit.reason.empty()) return fit;
  const SmoothCost cost = [&](std::span<const double> x, double& value,
                              std::span<double> gradient) {
    return cost_at(differences, x, value, gradient);
  };
  const std::vector<std::vector<double>> from = starts(differences);
  const LikelihoodOptimum optimum = likelihood_optimum(cost, from);
  if (flat_cost(differences) <= optimum.cost + kNoGain) {
    fit.reason = "flat: \"different\" does not become more frequent with the difference";
    return fit;
  }
  if (!optimum.converged) {
    fit.status = FitStatus::kNotConverged;
    fit.reason = "the search for the optimum did not come to rest";
    return fit;
  }
  fit.status = FitStatus::kOk;
  const double spread = std::exp(optimum.at[0]);
  const double ratio = std::exp(optimum.at[1]);
  fit.weber_fraction = std::expm1(spread);
  fit.criterion_ln = ratio * spread;
  fit.false_alarm_rate = 2.0 * normal_tails(-ratio).lower;
  fit.log_likelihood = -optimum.cost;
  const Interval spread_log = likelihood_ratio_interval(cost, optimum, from, 0, kFarthestLog);
  if (spread_log.low) fit.weber_fraction_ci95.low = std::expm1(std::exp(*spread_log.low));
  if (spread_log.high) fit.weber_fraction_ci95.high = std::expm1(std::exp(*spread_log.high));
  // This cost has ln k = ln s + ln (k / s) in place of ln (k / s).
  const SmoothCost by_criterion = [&](std::span<const double> x, double& value,
                                      std::span<double> gradient) {
    const std::vector<double> of_ratio = {x[0], x[1] - x[0]};
    if (!cost_at(differences, of_ratio, value, gradient)) return false;
    gradient[0] -= gradient[1];
    return true;
  };
  const LikelihoodOptimum with_criterion{
      {optimum.at[0], optimum.at[0] + optimum.at[1]}, optimum.cost, true};
  const Interval criterion =
      likelihood_ratio_interval(by_criterion, with_criterion, from, 1, kFarthestLog);
  if (criterion.low) fit.criterion_ln_ci95.low = std::exp(*criterion.low);
  if (criterion.high) fit.criterion_ln_ci95.high = std::exp(*criterion.high);
  return fit;
}

double different_probability(double intensity, double reference, double criterion_ln,
                             double spread_ln) {
  const double d = std::log(intensity / reference);
  return normal_tails((-criterion_ln + d) / spread_ln).lower +
         normal_tails((-criterion_ln - d) / spread_ln).lower;
}

}  // namespace jnd::analysis
