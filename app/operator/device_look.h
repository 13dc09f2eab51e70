#pragma once

#include <string>

#include "app/commissioning/commissioning.h"
#include "app/operator/device_view.h"

namespace jnd::app {

/// Rate of the loop by which devices are looked at and measured.
inline constexpr double kDeviceRate_hz = 1000.0;

/// What can be told of a device without opening it: description, profile, what was measured so
/// far. One across a network is asked. What goes wrong is a sentence in it. `profile`: a file;
/// "": its own is looked for. Not real time.
[[nodiscard]] DeviceView look_at_device(const std::string& name, const std::string& profile,
                                        const MeasuringPlan& plan);

/// One line of the start view: which device waits, and whether its profile is valid. Without
/// asking one across a network.
[[nodiscard]] PreflightLine waiting_device_line(const std::string& name,
                                                const std::string& profile);

/// How a step stands, for the view; `results` of the record.
[[nodiscard]] DeviceView::Step step_line(CommissioningStep step,
                                         const CommissioningResults& results);

}  // namespace jnd::app
