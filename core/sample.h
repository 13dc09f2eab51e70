#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <type_traits>

#include "core/device_channels.h"
#include "core/hand.h"
#include "core/joints.h"

namespace jnd::core {

/// One recorded tick of the haptic loop, in the workspace frame. Trivially copyable, because it
/// leaves the haptic thread through an `SpscQueue`.
struct Sample {
  /// Counted from 0 at the start of the session's recording. Ticks that were due and never ran
  /// count as well.
  std::int64_t tick = 0;
  /// Ticks that were due and never ran right before this one.
  std::int64_t num_missed_before = 0;
  /// CLOCK_MONOTONIC when the tick began, to 1 us in recordings. 0 in simulated time, in which
  /// the ticks tell the time.
  std::int64_t monotonic_ns = 0;
  /// Time of the measurement by the device's own clock; 0 in simulated time.
  std::int64_t device_time_ns = 0;
  std::uint32_t command_sequence = 0;
  std::uint8_t attached_bits = 0;  ///< Bit i: contact point i is attached to the hand.
  std::uint8_t immersed_bits = 0;  ///< Bit i: contact point i is in the medium.
  std::uint8_t limited = 0;        ///< 1 if the force limiter changed the force.
  std::uint8_t fault = 0;          ///< `Fault`; 0 means none.
  std::array<PlainVector, kNumContactPoints> tip_position_m{};
  std::array<PlainVector, kNumContactPoints> tip_velocity_m_per_s{};
  /// Force on the hand as sent to the device, after every limit.
  std::array<PlainVector, kNumContactPoints> tip_force_n{};
  PlainVector end_effector_position_m{};
  // All 0 from a device without joints.
  std::array<float, kNumJoints> joint_position_rad{};
  std::array<float, kNumJoints> joint_torque_n_m{};  ///< As measured by the device's sensors.
  DeviceChannels channels;
};

static_assert(std::is_trivially_copyable_v<Sample>);

/// Returns the delivered force on the hand at each point: as measured by force sensors if the
/// device has them, and as sent otherwise. Real time.
[[nodiscard]] inline const std::array<PlainVector, kNumContactPoints>& delivered_force_n(
    const Sample& sample) noexcept {
  return sample.channels.has(kMeasuredForce) ? sample.channels.force_n : sample.tip_force_n;
}

/// Returns bits of which bit i says that the device has contact point i. A point that the
/// device lacks is detached and at exactly zero, so that sums over all points are sums over
/// those it has. Real time.
[[nodiscard]] inline std::uint8_t measured_bits(const Sample& sample) noexcept {
  unsigned bits = sample.attached_bits;
  for (unsigned point = 0; point < kNumContactPoints; ++point) {
    if (sample.tip_position_m[point] != PlainVector{}) bits |= 1U << point;
  }
  return static_cast<std::uint8_t>(bits);
}

/// Returns the number of points over which a mean of the hand is taken: the points that the
/// device has, or all if the sample shows none.
[[nodiscard]] inline int num_measured_points(const Sample& sample) noexcept {
  const int num_points = std::popcount(static_cast<unsigned>(measured_bits(sample)));
  return num_points > 0 ? num_points : kNumContactPoints;
}

}  // namespace jnd::core
