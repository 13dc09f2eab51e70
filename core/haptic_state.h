#pragma once

#include <array>
#include <cstdint>

#include "core/device_channels.h"
#include "core/hand.h"
#include "core/joints.h"

namespace jnd::core {

/// What a device measured in one tick. Workspace frame: +x to the participant's right, +y away
/// from the participant, +z up; the surface of a fluid is the plane z = 0, the fluid is below.
struct HapticState {
  std::int64_t device_time_ns = 0;  ///< The device's own clock; must advance every tick.
  /// When it came, by our monotonic clock; 0: with this tick.
  std::int64_t arrived_ns = 0;
  /// Whether the robot's own side lets it give force: an enabling switch there, or a key. Where
  /// it is open nothing this program does brings force.
  bool enabled = true;
  PointVectors tip_position_m{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                              Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                              Eigen::Vector3d::Zero()};
  PointVectors tip_velocity_m_per_s{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                    Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                    Eigen::Vector3d::Zero()};
  /// Whether the point is held to the hand. A point that came off gets no force.
  std::array<bool, kNumContactPoints> attached{true, true, true, true, true};
  /// On the hand, from the measurement before until this one: of a device whose
  /// `DeviceCapabilities` say that it tells, else zeros.
  PointVectors acted_n{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                       Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                       Eigen::Vector3d::Zero()};
  Eigen::Vector3d end_effector_position_m = Eigen::Vector3d::Zero();  ///< Where the arm ends.
  std::array<double, kNumJoints> joint_position_rad{};  ///< 0 from a device without joints.
  std::array<double, kNumJoints>
      joint_torque_n_m{};  ///< Measured torques; 0 from a device without joints.
  DeviceChannels channels;
};

}  // namespace jnd::core
