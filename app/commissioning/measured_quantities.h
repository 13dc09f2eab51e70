#pragma once

#include <string>
#include <vector>

#include "app/commissioning/commissioning.h"

namespace jnd::app {

/// A quantity of a device as a report has it: "Own damping", "2.41", "2.39 to 2.43", "N s/m".
struct MeasuredQuantity {
  std::string what, estimate, interval, unit;
};

/// Every quantity that a step found, in its order; none where it was not measured.
[[nodiscard]] std::vector<MeasuredQuantity> quantities_in(CommissioningStep step,
                                                          const CommissioningResults& results);

/// What matters most, a sentence each: what arrives of a force, what is added to it, how late.
[[nodiscard]] std::vector<std::string> main_findings(const CommissioningResults& results);

}  // namespace jnd::app
