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

/// x, y, z without Eigen, which is not trivially copyable.
using PlainVector = std::array<double, 3>;

/// A set of what a device may measure beside positions and velocities.
using ChannelBits = std::uint8_t;
inline constexpr ChannelBits kMeasuredForce = 1 << 0;
inline constexpr ChannelBits kOrientation = 1 << 1;
inline constexpr ChannelBits kTorque = 1 << 2;
inline constexpr ChannelBits kGripper = 1 << 3;
inline constexpr ChannelBits kButtons = 1 << 4;
inline constexpr ChannelBits kAllChannels = (1 << 5) - 1;

/// In the order of their bits, as JSON spells them.
inline constexpr std::array<std::string_view, 5> kChannelNames = {
    "measured_force", "orientation", "torque", "gripper", "buttons"};

/// The names of a set. Not real time.
[[nodiscard]] inline std::vector<std::string> channel_names(ChannelBits bits) {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < kChannelNames.size(); ++i) {
    if ((bits >> i & 1) != 0) names.emplace_back(kChannelNames[i]);
  }
  return names;
}

/// What it measured of these, workspace frame. What it does not measure stays as it is here.
/// Trivially copyable: it goes through queues and pages of memory.
struct DeviceChannels {
  ChannelBits bits = 0;  ///< Those that the device has, of every sample the same.
  /// On the hand at each point, by a sensor of force and not by what the motors were told, N.
  std::array<PlainVector, kNumContactPoints> force_n{};
  std::array<double, 4> orientation_wxyz{1.0, 0.0, 0.0, 0.0};  ///< Of the end effector, unit.
  PlainVector torque_n_m{};   ///< On the hand at the end effector.
  double gripper_m = 0.0;     ///< Opening.
  std::uint32_t buttons = 0;  ///< Bit i: button i is pressed.

  [[nodiscard]] bool has(ChannelBits channel) const noexcept { return (bits & channel) != 0; }
};
static_assert(std::is_trivially_copyable_v<DeviceChannels>);

/// Whether every number is one, and so large at most that a recording holds it, and the
/// orientation of a device that has one is one: others tell zeros. Real time.
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
