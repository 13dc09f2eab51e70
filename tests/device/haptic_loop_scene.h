#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "device/haptic_loop.h"
#include "scripted_device.h"

namespace jnd::device {

/// The moment in a loop's life at which it is struck.
enum class Phase { kFirstTick, kInRamp, kInContact, kInFadeOut, kAfterRearm };

inline constexpr std::array kPhases = {Phase::kFirstTick, Phase::kInRamp, Phase::kInContact,
                                       Phase::kInFadeOut, Phase::kAfterRearm};

inline const char* words(Phase phase) {
  switch (phase) {
    case Phase::kFirstTick:
      return "first tick";
    case Phase::kInRamp:
      return "in ramp";
    case Phase::kInContact:
      return "in contact";
    case Phase::kInFadeOut:
      return "in fade-out";
    case Phase::kAfterRearm:
      return "after re-arming";
  }
  return "";
}

/// Hands with 1, 3 and 5 points attached.
inline const std::array<std::array<bool, 5>, 3> kAttachments = {
    {{true, false, false, false, false}, {true, true, false, true, false}, core::kAllAttached}};

/// A hand that is lowered onto a rough solid plane below a viscous fluid, with a window that is
/// alive.
struct LoopScene {
  explicit LoopScene(const std::array<bool, 5>& attached = core::kAllAttached,
                     const HapticLoop::Parameters& parameters = {})
      : device(lowered_hand(attached)),
        loop(armed(parameters), device,
             {commands, published_telemetry, stop, nullptr, &heartbeat}) {
    command.medium =
        core::viscous({.viscosity_pa_s = 5.0}) +
        core::solid(
            {.stiffness_n_per_m = 300.0, .damping_n_s_per_m = 0.5, .friction_ratio = 0.4});
    command.immersion.origin_z_m = -0.1;
    command.ramp_s = 0.3;
    publish();
  }

  static HapticLoop::Parameters armed(HapticLoop::Parameters parameters) {
    parameters.starts_armed = true;
    return parameters;
  }

  void publish() {
    ++command.sequence;
    commands.publish(command);
  }

  void run(int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) {
      heartbeat.beat();
      loop.tick();
    }
  }

  void bring_to(Phase phase) {
    switch (phase) {
      case Phase::kFirstTick:
        break;
      case Phase::kInRamp:
        run(150);
        break;
      case Phase::kInContact:
        run(400);
        break;
      case Phase::kInFadeOut:
        run(200);
        // 250 ms of silence and 30 ms of the fading pass.
        for (int i = 0; i < 280; ++i) loop.tick();
        break;
      case Phase::kAfterRearm:
        run(200);
        stop.press();
        run(10);
        (void)stop.release(stop.num_presses());
        wait_to_arm();
        arm();
        run(200);
        break;
    }
  }

  /// Until somebody may, after a release (`core::kArmAfterRelease_s`); the hand rests
  /// meanwhile.
  void wait_to_arm() {
    const core::PointVectors moving_m_per_s = device.state.tip_velocity_m_per_s;
    device.move_all(Eigen::Vector3d::Zero());
    run(510);
    device.state.tip_velocity_m_per_s = moving_m_per_s;
  }
  /// As somebody who has seen all that is latched.
  void arm() {
    published_telemetry.fetch();
    loop.rearm(published_telemetry.value().num_faults);
  }

  core::Fault fault() {
    published_telemetry.fetch();
    return published_telemetry.value().fault;
  }

  /// What the device received last; zero before the first tick.
  [[nodiscard]] core::PointVectors last_received() const {
    return device.received.empty() ? core::zero_vectors() : device.received.back();
  }

  static ScriptedDevice lowered_hand(const std::array<bool, 5>& attached) {
    ScriptedDevice hand;
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      hand.state.tip_position_m[i].z() = -0.095 - 0.001 * i;
    }
    hand.state.attached = attached;
    hand.move_all({0.1, 0.02, -0.05});
    hand.device_capabilities.num_joints = core::kNumJoints;
    // The measurements follow from no force, so the port must not be watched.
    hand.device_capabilities.simulated = true;
    hand.device_capabilities.tells_acting_force = false;
    return hand;
  }

  ScriptedDevice device;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> published_telemetry;
  core::EmergencyStop stop;
  core::Heartbeat heartbeat;
  HapticLoop loop;
  core::HapticCommand command;
};

/// Whether a tick's force keeps what it always has to: it is finite, within the limits, zero at
/// a point that is off, and differs from the last tick by no more than the slew, unless it is
/// zero.
inline ::testing::AssertionResult is_safe(const core::PointVectors& force,
                                          const core::PointVectors& last,
                                          const std::array<bool, 5>& attached,
                                          const core::ForceLimiter::Parameters& limits = {},
                                          double period_s = 0.001) {
  double sum_n = 0.0;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (!force[i].allFinite()) return ::testing::AssertionFailure() << "not finite: " << i;
    const double magnitude_n = force[i].norm();
    sum_n += magnitude_n;
    if (magnitude_n > limits.per_point_n + 1e-9) {
      return ::testing::AssertionFailure() << magnitude_n << " N at point " << i;
    }
    if (!attached[i] && magnitude_n != 0.0) {
      return ::testing::AssertionFailure() << magnitude_n << " N at detached point " << i;
    }
    const double step_n = (force[i] - last[i]).norm();
    if (magnitude_n != 0.0 && step_n > limits.slew_n_per_s * period_s + 1e-9) {
      return ::testing::AssertionFailure() << "a step of " << step_n << " N at point " << i;
    }
  }
  if (sum_n > limits.total_n + 1e-9) {
    return ::testing::AssertionFailure() << sum_n << " N in all";
  }
  return ::testing::AssertionSuccess();
}

inline double sum_of_magnitudes_n(const core::PointVectors& force) {
  double sum_n = 0.0;
  for (const Eigen::Vector3d& part : force) sum_n += part.norm();
  return sum_n;
}

}  // namespace jnd::device
