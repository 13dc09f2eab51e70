#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "core/hand.h"

namespace jnd::core {

/// x, y and z. An Eigen vector is not trivially copyable.
using PlainVector = std::array<double, 3>;

/// A set of what a device may measure besides positions and velocities.
using ChannelBits = std::uint8_t;
inline constexpr ChannelBits kMeasuredForce = 1 << 0;
inline constexpr ChannelBits kOrientation = 1 << 1;
inline constexpr ChannelBits kTorque = 1 << 2;
inline constexpr ChannelBits kGripper = 1 << 3;
inline constexpr ChannelBits kButtons = 1 << 4;
inline constexpr ChannelBits kAllChannels = (1 << 5) - 1;

/// Their names in the order of their bits, as JSON spells them.
inline constexpr std::array<std::string_view, 5> kChannelNames = {
    "measured_force", "orientation", "torque", "gripper", "buttons"};

/// Returns the names of a set. Not real time.
[[nodiscard]] inline std::vector<std::string> channel_names(ChannelBits bits) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kChannelNames.size(); ++i) {
    if ((bits >> i & 1) != 0) names.emplace_back(kChannelNames[i]);
  }
  return names;
}

/// What a device measured of these channels, in the workspace frame. Channels that the device
/// lacks keep the defaults. Trivially copyable, because it passes through queues and shared
/// memory.
struct DeviceChannels {
  ChannelBits bits = 0;  ///< Channels that the device has; the same in every sample.
  /// Force on the hand at each point, N, from force sensors and not from motor commands.
  std::array<PlainVector, kNumContactPoints> force_n{};
  /// Orientation of the end effector, a unit quaternion.
  std::array<double, 4> orientation_wxyz{1.0, 0.0, 0.0, 0.0};
  PlainVector torque_n_m{};   ///< Torque on the hand at the end effector.
  double gripper_m = 0.0;     ///< Opening of the gripper.
  std::uint32_t buttons = 0;  ///< Bit i is 1 while button i is pressed.

  [[nodiscard]] bool has(ChannelBits channel) const noexcept { return (bits & channel) != 0; }
};
static_assert(std::is_trivially_copyable_v<DeviceChannels>);

/// Whether every number is finite and small enough for a recording, and the orientation is a
/// unit quaternion if the device has one. (Devices without an orientation report zeros.) Real
/// time.
[[nodiscard]] inline bool is_sound(const DeviceChannels& channels) noexcept {
  constexpr double kMost = 1e6, kMostOffUnit = 0.01;
  double sum = std::abs(channels.gripper_m), squared = 0.0;
  for (const PlainVector& force_n : channels.force_n) {
    for (const double one : force_n) sum += std::abs(one);
  }
  for (const double one : channels.torque_n_m) sum += std::abs(one);
  for (const double one : channels.orientation_wxyz) squared += one * one;
  const bool is_turned =
      channels.has(kOrientation) ? std::abs(squared - 1.0) <= kMostOffUnit : squared < kMost;
  return sum < kMost && is_turned && (channels.bits & ~kAllChannels) == 0;
}

}  // namespace jnd::core
