#include "app/results/published_words.h"

#include <fmt/format.h>

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

std::string tail_words(const Estimate& estimate, const analysis::Predictive& predictive) {
  if (!estimate.predictive || predictive.num_studies < 1) return "";
  const double share = estimate.predictive->tail;
  const char* side = estimate.predictive->is_below ? "below" : "above";
  if (share > 0.0) {
    return fmt::format("{:.3f} {} (se {:.3f})", share, side,
                       estimate.predictive->standard_error);
  }
  return fmt::format("< {:.3f} {}", 1.0 / predictive.num_studies, side);
}

}  // namespace jnd::app
