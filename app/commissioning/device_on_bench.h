#pragma once

#include <array>
#include <functional>

#include "app/commissioning/guided_run.h"
#include "app/commissioning/measuring_plan.h"
#include "core/sample.h"
#include "device/bench.h"
#include "device/haptic_device.h"

namespace jnd::app {

using GuideOrder = device::MotionGuide::Order;

[[nodiscard]] Eigen::Vector3d vector_of(const core::PlainVector& plain) noexcept;
[[nodiscard]] std::array<double, 3> plain_of(const Eigen::Vector3d& vector) noexcept;
/// The mean of the points that the device has.
[[nodiscard]] Eigen::Vector3d hand_m(const core::Sample& sample,
                                     const device::DeviceCapabilities& can) noexcept;
/// The sum of all forces that were sent.
[[nodiscard]] Eigen::Vector3d commanded_n(const core::Sample& sample) noexcept;

/// A hold for a device about which nothing is known yet; it is soft enough for any.
inline constexpr GuideOrder kSoftHold = {
    .stiffness_n_per_m = 40.0, .damping_n_s_per_m = 3.0, .is_on = true};

/// A hold that is firm enough for pushes, sweeps and stimuli.
inline constexpr GuideOrder kFirmHold = {
    .stiffness_n_per_m = 100.0, .damping_n_s_per_m = 10.0, .is_on = true};

/// A device without a hand, and its loop. Nothing moves the device before `hold`.
class DeviceOnBench {
 public:
  /// `how` gives limits and guard; the plan gives the rest.
  DeviceOnBench(device::HapticDevice& device, device::Bench& bench, const MeasuringPlan& plan,
                const GuidedRun::Parameters& how = {});

  [[nodiscard]] GuidedRun& run() noexcept { return run_; }
  [[nodiscard]] const device::DeviceCapabilities& can() const noexcept { return can_; }

  [[nodiscard]] Eigen::Vector3d place_m();

  /// Holds it where it is by its own force, which grows while somebody holds it who has been
  /// told, and is then let go. Throws `core::Error` where that force moves it.
  void hold(GuideOrder order);

  /// Somebody does this at it: it is held meanwhile and has no force. Then as `hold`.
  void act(const std::function<void()>& act);

  /// Goes to this place and waits until the device is there.
  void go_to(const Eigen::Vector3d& place_m, GuideOrder order);

  /// Waits until the device moves no more than 0.3 mm in 0.2 s, but at most 4 s, because links
  /// may sway behind the tool for long. `take` gets the samples meanwhile.
  void come_to_rest(const std::function<void(const core::Sample&)>& take = {});

 private:
  void take_over(GuideOrder order);

  device::Bench& bench_;
  device::DeviceCapabilities can_;
  GuidedRun run_;
};

}  // namespace jnd::app
