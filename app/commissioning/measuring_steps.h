#pragma once

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "analysis/commissioning/delay_fit.h"
#include "analysis/commissioning/force_fit.h"
#include "analysis/commissioning/frame_fit.h"
#include "analysis/commissioning/homing_fit.h"
#include "analysis/commissioning/noise_fit.h"
#include "analysis/commissioning/stability_fit.h"
#include "app/commissioning/device_on_bench.h"
#include "app/commissioning/guided_pushes.h"
#include "app/commissioning/guided_ways.h"
#include "app/commissioning/measuring_plan.h"
#include "app/language/words.h"
#include "device/bench.h"
#include "device/haptic_device.h"

namespace jnd::app {

/// The corners of a box of 20 cm around the home of a hand, 15 cm below the surface.
[[nodiscard]] std::vector<Eigen::Vector3d> default_marks_m();

/// Told while somebody holds the tool at a mark.
inline constexpr const char* kMarkIsRead = tr_later("A mark is touched and read.");

/// Told how much of a step is done, 0 to 1, and what happens now.
using StepProgress = std::function<void(double done, const std::string& now)>;

/// Measures the noise and the least step of a device at rest, in a moment. Throws as
/// `GuidedRun` does.
[[nodiscard]] analysis::NoiseFit noise_at_rest(DeviceOnBench& started);
/// Somebody touches this mark, and the place that the device tells is read. Throws as
/// `GuidedRun` does.
[[nodiscard]] analysis::TouchedMark touched_mark(DeviceOnBench& started, device::Bench& bench,
                                                 const Eigen::Vector3d& mark_m);

/// Each function makes one measurement. `bench` is a simulated person, or a real one who is
/// asked. Each throws `core::Error` in a sentence if the device cannot be started, if it
/// stopped with a fault, or if the result is no valid measurement. The device is closed
/// afterwards, and earlier results stay as they are. Not real time.
[[nodiscard]] analysis::HomingFit measure_homing(device::HapticDevice& device,
                                                 device::Bench& bench,
                                                 const MeasuringPlan& plan,
                                                 const StepProgress& progress);
[[nodiscard]] analysis::NoiseFit measure_noise(device::HapticDevice& device,
                                               device::Bench& bench, const MeasuringPlan& plan,
                                               const StepProgress& progress);
[[nodiscard]] analysis::FrameFit measure_frame(device::HapticDevice& device,
                                               device::Bench& bench, const MeasuringPlan& plan,
                                               const StepProgress& progress);
/// Measures gain, weight, damping and friction, by ways along three axes and by known loads.
/// `frame` says which way is up.
[[nodiscard]] analysis::ForceFit measure_force(device::HapticDevice& device,
                                               device::Bench& bench, const MeasuringPlan& plan,
                                               const analysis::FrameFit& frame,
                                               const StepProgress& progress);
/// Computes the same from ways and pushes that were made; throws as `analysis::fit_force` does.
[[nodiscard]] analysis::ForceFit fit_ways(const GuidedWays& ways, const GuidedPushes& pushes,
                                          const Eigen::Vector3d& up,
                                          double load_uncertainty_ratio);
/// Measures delay and mass, by pushes to and fro while the device moves on. `force` says how
/// the device is damped.
[[nodiscard]] analysis::DelayFit measure_delay(device::HapticDevice& device,
                                               device::Bench& bench, const MeasuringPlan& plan,
                                               const analysis::ForceFit& force,
                                               const StepProgress& progress);
/// Measures up to which viscosity and stiffness the device is stable, by its response to sweeps
/// in three poses, and by rendering what that response allows. Nothing beyond it is rendered.
[[nodiscard]] analysis::StabilityFit measure_stability(
    device::HapticDevice& device, device::Bench& bench, const MeasuringPlan& plan,
    const analysis::NoiseFit& noise, const analysis::ForceFit& force,
    const analysis::DelayFit& delay, const StepProgress& progress);

}  // namespace jnd::app
