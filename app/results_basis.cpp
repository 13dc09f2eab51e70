#include "app/results_basis.h"

namespace jnd::app {

using analysis::Estimate;
using analysis::Interval;

std::string basis_of(const Estimate& estimate) {
  if (estimate.calibrated) return "calibrated";
  return estimate.implied ? "implied" : "held out";
}

std::optional<bool> holds_published(const Estimate& estimate) {
  const Interval& ci95 = estimate.ci95;
  if (estimate.published_positive && ci95.low) return *ci95.low > 0.0;
  if (!estimate.published || (!ci95.low && !ci95.high)) return std::nullopt;
  return (!ci95.low || *estimate.published >= *ci95.low) &&
         (!ci95.high || *estimate.published <= *ci95.high);
}

}  // namespace jnd::app
