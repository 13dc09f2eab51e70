#include "analysis/results/missing_values.h"
#include "analysis/words/said.h"

#include <cmath>

namespace jnd::analysis {

void explain_missing(StudyResults& results) {
  for (ResultsSection& section : results.sections) {
    for (Estimate& estimate : section.estimates) {
      const bool has_value = estimate.value && std::isfinite(*estimate.value);
      if (has_value) {
        estimate.reason.clear();
        continue;
      }
      if (!estimate.reason.empty()) continue;
      const bool is_spread = estimate.name.find("sd") != std::string::npos;
      if (estimate.n == 0) estimate.reason = said("nobody has a value");
      if (estimate.n == 1 && is_spread) estimate.reason = said("one value has no spread");
    }
  }
}

}  // namespace jnd::analysis
