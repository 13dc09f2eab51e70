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

/// The corners of a box of 20 cm about the home of a hand, 15 cm below the surface.
[[nodiscard]] std::vector<Eigen::Vector3d> default_marks_m();

/// What is told while somebody holds the tool at a mark.
inline constexpr const char* kMarkIsRead = tr_later("A mark is touched and read.");

/// Told how much of a step is done, 0 to 1, and what happens now.
using StepProgress = std::function<void(double done, const std::string& now)>;

/// Of a device that rests: noise and least step. For a moment. Throws as `GuidedRun` does.
[[nodiscard]] analysis::NoiseFit noise_at_rest(DeviceOnBench& started);
/// Somebody touches this mark, and it is read where the device says that it is. Likewise.
[[nodiscard]] analysis::TouchedMark touched_mark(DeviceOnBench& started, device::Bench& bench,
                                                 const Eigen::Vector3d& mark_m);

/// One measurement each. `bench`: somebody simulated, or a person who is asked. Every one of
/// them throws `core::Error` in a sentence: the device cannot be started, it stopped with a
/// fault, or what came of it is no measurement. The device is closed afterwards, and what was
/// found before is not touched. Not real time.
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
/// Gain, weight, damping and friction, by ways along three axes and known loads. `frame` says
/// which way is up.
[[nodiscard]] analysis::ForceFit measure_force(device::HapticDevice& device,
                                               device::Bench& bench, const MeasuringPlan& plan,
                                               const analysis::FrameFit& frame,
                                               const StepProgress& progress);
/// The same of ways and pushes that were made; throws as `analysis::fit_force` does.
[[nodiscard]] analysis::ForceFit fit_ways(const GuidedWays& ways, const GuidedPushes& pushes,
                                          const Eigen::Vector3d& up,
                                          double load_uncertainty_ratio);
/// Delay and mass, by pushes to and fro as the device moves on; `force` says how it is damped.
[[nodiscard]] analysis::DelayFit measure_delay(device::HapticDevice& device,
                                               device::Bench& bench, const MeasuringPlan& plan,
                                               const analysis::ForceFit& force,
                                               const StepProgress& progress);
/// Up to which viscosity and stiffness it is stable, by its response to sweeps in three poses,
/// and by rendering what that allows. Nothing is rendered beyond it.
[[nodiscard]] analysis::StabilityFit measure_stability(
    device::HapticDevice& device, device::Bench& bench, const MeasuringPlan& plan,
    const analysis::NoiseFit& noise, const analysis::ForceFit& force,
    const analysis::DelayFit& delay, const StepProgress& progress);

}  // namespace jnd::app
