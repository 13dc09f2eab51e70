#pragma once

#include <string>
#include <vector>

#include "app/commissioning/commissioning.h"

namespace jnd::app {

/// A quantity of a device, as a report shows it: "Own damping", "2.41", "2.39 to 2.43", "N
/// s/m".
struct MeasuredQuantity {
  std::string what, estimate, interval, unit;
};

/// Every quantity that a step found, in order; none if the step was not measured.
[[nodiscard]] std::vector<MeasuredQuantity> quantities_in(CommissioningStep step,
                                                          const CommissioningResults& results);

/// The most important findings, one sentence each: how much of a force arrives, what is added
/// to it, and how late it is.
[[nodiscard]] std::vector<std::string> main_findings(const CommissioningResults& results);

}  // namespace jnd::app
