#pragma once

#include <string>

#include "app/commissioning/commissioning.h"
#include "app/operator/device_view.h"

namespace jnd::app {

/// The rate of the loop by which devices are looked at and measured.
inline constexpr double kDeviceRate_hz = 1000.0;

/// Collects what can be told about a device without opening it: its description, its profile,
/// and what was measured so far. A device across a network is asked. Problems are sentences in
/// the result. `profile` is a file; if "", the device's own profile is looked for. Not real
/// time.
[[nodiscard]] DeviceView look_at_device(const std::string& name, const std::string& profile,
                                        const MeasuringPlan& plan);

/// One line of the start view: the proposed device, and whether its profile is valid. A device
/// across a network is not asked.
[[nodiscard]] PreflightLine waiting_device_line(const std::string& name,
                                                const std::string& profile);

/// The state of a step, for the view. `results` are those of the record.
[[nodiscard]] DeviceView::Step step_line(CommissioningStep step,
                                         const CommissioningResults& results);

}  // namespace jnd::app
