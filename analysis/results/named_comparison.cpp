#include <cmath>
#include <optional>

#include "analysis/results/study_results.h"

namespace jnd::analysis {
namespace {

std::optional<double> exponential(const std::optional<double>& logarithm) {
  return logarithm ? std::optional(std::exp(*logarithm)) : std::nullopt;
}

}  // namespace

std::optional<double> NamedComparison::ratio() const {
  if (ratio_of.empty()) return std::nullopt;
  return exponential(comparison.hodges_lehmann ? comparison.hodges_lehmann
                                               : comparison.estimate);
}

Interval NamedComparison::ratio_ci95() const {
  if (ratio_of.empty()) return {};
  const Interval& interval =
      comparison.hodges_lehmann ? comparison.hodges_lehmann_ci95 : comparison.ci95;
  return {exponential(interval.low), exponential(interval.high)};
}

}  // namespace jnd::analysis
