#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "core/device_channels.h"
#include "core/hand.h"
#include "core/joints.h"

namespace jnd::core {

/// One recorded tick of the haptic loop, workspace frame. Trivially copyable: it leaves the
/// haptic thread through an `SpscQueue`.
struct Sample {
  /// Counted from 0 at the start of the session's recording, a period of the loop each: ticks
  /// that were due and never ran are counted, too.
  std::int64_t tick = 0;
  std::int64_t num_missed_before = 0;  ///< Such ticks right before this one.
  /// Of CLOCK_MONOTONIC when the tick began, to 1 us in recordings. 0 in simulated time, which
  /// is that of the ticks.
  std::int64_t monotonic_ns = 0;
  std::int64_t device_time_ns =
      0;  ///< When it was measured, by the device's own clock; 0 in simulated time.
  std::uint32_t command_sequence = 0;
  std::uint8_t attached_bits = 0;  ///< Bit i: contact point i holds the hand.
  std::uint8_t immersed_bits = 0;  ///< Bit i: contact point i is in the medium.
  std::uint8_t limited = 0;        ///< 1 where the force limiter changed the force.
  std::uint8_t fault = 0;          ///< `Fault`, 0 is none.
  std::array<PlainVector, kNumContactPoints> tip_position_m{};
  std::array<PlainVector, kNumContactPoints> tip_velocity_m_per_s{};
  /// Force on the hand as sent to the device, after every limit.
  std::array<PlainVector, kNumContactPoints> tip_force_n{};
  PlainVector end_effector_position_m{};
  // All 0 from a device without joints.
  std::array<float, kNumJoints> joint_position_rad{};
  std::array<float, kNumJoints> joint_torque_n_m{};  ///< As the device's sensors say.
  DeviceChannels channels;
};

static_assert(std::is_trivially_copyable_v<Sample>);

/// Force on the hand at each point that was delivered: what sensors of force measured where the
/// device has them, else what was sent to it. Real time.
[[nodiscard]] inline const std::array<PlainVector, kNumContactPoints>& delivered_force_n(
    const Sample& sample) noexcept {
  return sample.channels.has(kMeasuredForce) ? sample.channels.force_n : sample.tip_force_n;
}

/// Bit i: the device has contact point i. One that it does not have holds nothing and lies at
/// exactly zero, so that sums over all points are sums over those. Real time.
[[nodiscard]] inline std::uint8_t measured_bits(const Sample& sample) noexcept {
  unsigned bits = sample.attached_bits;
  for (unsigned point = 0; point < kNumContactPoints; ++point) {
    if (sample.tip_position_m[point] != PlainVector{}) bits |= 1U << point;
  }
  return static_cast<std::uint8_t>(bits);
}

/// How many points a mean over the hand is of: those that the device has; of a sample that
/// tells of none, all.
[[nodiscard]] inline int num_measured_points(const Sample& sample) noexcept {
  const int num_points = std::popcount(static_cast<unsigned>(measured_bits(sample)));
  return num_points > 0 ? num_points : kNumContactPoints;
}

}  // namespace jnd::core
