#pragma once

#include <array>
#include <cstdint>

#include "core/device_channels.h"
#include "core/hand.h"
#include "core/joints.h"

namespace jnd::core {

/// What a device measured in one tick, in the workspace frame: +x points to the participant's
/// right, +y away from the participant, +z up. The surface of a fluid is the plane z = 0, with
/// the fluid below.
struct HapticState {
  std::int64_t device_time_ns = 0;  ///< The device's own clock; it must advance in every tick.
  /// When the measurement arrived, by our monotonic clock; 0 means in this tick.
  std::int64_t arrived_ns = 0;
  /// Whether the robot itself allows force, for example by an enabling switch or a key. While
  /// it does not, nothing in this program can produce force.
  bool enabled = true;
  PointVectors tip_position_m{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                              Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                              Eigen::Vector3d::Zero()};
  PointVectors tip_velocity_m_per_s{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                    Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                                    Eigen::Vector3d::Zero()};
  /// Whether the point is attached to the hand. A point that came off gets no force.
  std::array<bool, kNumContactPoints> attached{true, true, true, true, true};
  /// Mean force on the hand between the previous measurement and this one. All zero unless the
  /// device's `DeviceCapabilities` say that it reports it.
  PointVectors acted_n{Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                       Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(),
                       Eigen::Vector3d::Zero()};
  Eigen::Vector3d end_effector_position_m = Eigen::Vector3d::Zero();  ///< End of the arm.
  std::array<double, kNumJoints> joint_position_rad{};  ///< 0 from a device without joints.
  std::array<double, kNumJoints>
      joint_torque_n_m{};  ///< Measured torques; 0 from a device without joints.
  DeviceChannels channels;
};

}  // namespace jnd::core
