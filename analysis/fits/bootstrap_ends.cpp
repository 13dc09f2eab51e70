#include "analysis/fits/bootstrap_ends.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/statistics/summary.h"
#include "core/psychometric_function.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr double kBootstrapTail = 0.025;
constexpr double kMostRefits = 1e6;

std::optional<double> end_at(const std::vector<double>& ascending, double probability) {
  const double value = percentile(ascending, probability);
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

/// Opens both ends of an interval that would miss the estimate, and returns whether it did so.
bool refused(Interval& interval, double estimate) {
  if (estimate >= interval.low.value_or(-core::kInfinity) &&
      estimate <= interval.high.value_or(core::kInfinity)) {
    return false;
  }
  interval = {};
  return true;
}

/// The probability at which BCa reads the end that the percentile interval reads at `tail_z`;
/// none if the acceleration turns the correction around.
std::optional<double> corrected_probability(double tail_z, double bias, double acceleration) {
  const double shifted = bias + tail_z;
  const double stretch = 1.0 - acceleration * shifted;
  if (!(stretch > 0.0)) return std::nullopt;
  return core::standard_normal_cdf(bias + shifted / stretch);
}

/// How many refits it takes until at least one lies beyond this probability, whichever tail it
/// is in.
double refits_beyond(double probability) {
  const double tail = std::min(probability, 1.0 - probability);
  return std::ceil(1.0 / tail) - 1.0;
}

void add_bca(BootstrapEnds& result, const std::vector<double>& ascending, double estimate,
             std::optional<double> acceleration) {
  double below = 0.0;
  for (const double value : ascending) below += value < estimate ? 1.0 : 0.0;
  for (const double value : ascending) below += value == estimate ? 0.5 : 0.0;
  const double share = below / static_cast<double>(ascending.size());
  if (!(share > 0.0 && share < 1.0)) {
    result.bca_reason = "all refits lie on one side of the estimate";
    return;
  }
  if (!acceleration) {
    result.bca_reason = "without one of the answers there is no fit: no acceleration";
    return;
  }
  const double bias = core::standard_normal_quantile(share);
  const double z = core::standard_normal_quantile(kBootstrapTail);
  const std::optional<double> low = corrected_probability(z, bias, *acceleration);
  const std::optional<double> high = corrected_probability(-z, bias, *acceleration);
  result.bias_correction = bias;
  if (!low || !high) {
    result.bca_reason = "single answers have so much influence that there is no correction";
    return;
  }
  const double needed = std::max(refits_beyond(*low), refits_beyond(*high));
  if (!(needed <= static_cast<double>(ascending.size()))) {
    result.bca_reason =
        needed < kMostRefits
            ? fmt::format("its ends lie beyond the outermost refits; {:.0f} refits are needed",
                          needed)
            : "its ends lie beyond the outermost refits, however many there are";
    return;
  }
  result.bca_ci95 = {.low = end_at(ascending, *low), .high = end_at(ascending, *high)};
  if (!(*low < *high) || refused(result.bca_ci95, estimate)) {
    result.bca_ci95 = {};
    result.bca_reason = "refused, because it would miss the estimate";
  }
}

}  // namespace

std::optional<double> acceleration_of(const std::vector<LeftOut>& all) {
  double sum = 0.0, num_answers = 0.0, squares = 0.0, cubes = 0.0;
  for (const LeftOut& one : all) {
    sum += one.num_answers * one.value;
    num_answers += one.num_answers;
  }
  for (const LeftOut& one : all) {
    const double influence = sum / num_answers - one.value;
    squares += one.num_answers * influence * influence;
    cubes += one.num_answers * influence * influence * influence;
  }
  if (!(squares > 0.0)) return std::nullopt;
  return cubes / (6.0 * std::pow(squares, 1.5));
}

std::string too_few_refits() {
  return fmt::format(
      "a bootstrap of fewer than {} refits has no interval, for none lies beyond its ends: ask "
      "for 1000 or more",
      kFewestRefits);
}

BootstrapEnds bootstrap_ends(const std::vector<double>& ascending, double estimate,
                             std::optional<double> acceleration) {
  BootstrapEnds result;
  if (ascending.size() >= static_cast<std::size_t>(kFewestRefits)) {
    result.ci95 = {.low = end_at(ascending, kBootstrapTail),
                   .high = end_at(ascending, 1.0 - kBootstrapTail)};
    result.is_refused = refused(result.ci95, estimate);
  }
  add_bca(result, ascending, estimate, acceleration);
  return result;
}

}  // namespace jnd::analysis
