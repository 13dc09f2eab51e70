#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "core/clock_comparison.h"
#include "core/contact_sums.h"
#include "core/exposure.h"
#include "core/force_counts.h"
#include "core/safety/fault.h"
#include "core/safety/guard.h"
#include "core/sample.h"

namespace jnd::core {

/// What the haptic loop tells the rest of the program after each tick, in the workspace frame.
/// Trivially copyable, because it leaves the haptic thread through a `LatestValue`.
struct Telemetry {
  std::int64_t num_ticks = 0;          ///< Ticks that this loop has done; 0 means "none yet".
  std::int64_t num_missed_ticks = 0;   ///< Ticks so far that were due and never ran.
  Sample sample;                       ///< The last sample, as it is recorded.
  std::uint64_t command_sequence = 0;  ///< Sequence number of the command in force.
  Fault fault = Fault::kNone;
  Arming arming = Arming::kDisarmed;
  bool enabled = true;   ///< The device's own enabling switch is closed, or it has none.
  bool limited = false;  ///< The limiter changed the force in this tick.
  /// A guard that is close to its fault, or that takes a force away until the hand moves.
  Fault warning = Fault::kNone;
  GuardCounts guards;         ///< Counts since the loop began.
  bool ramp_finished = true;  ///< The medium in force is the commanded one.
  /// 1 normally, and less while the force fades out or in again.
  double authority_ratio = 1;
  PlainVector hand_position_m{};        ///< Mean of the tips that the device has.
  PlainVector hand_velocity_m_per_s{};  ///< Mean of the attached tips.
  /// Sum of the forces on the hand over all points, after every limit.
  PlainVector total_force_n{};
  std::uint64_t num_dropped_samples = 0;
  /// So far, each kind once until it is armed again: who looks now and then misses none, and
  /// who arms says how many were seen.
  std::uint64_t num_faults = 0;
  /// How often each point came off so far.
  std::array<std::uint32_t, kNumContactPoints> num_detachments{};
  std::uint64_t num_limited_ticks = 0;     ///< So far; a difference over a trial marks it.
  Exposure exposure;                       ///< Since the loop began, to forces as sent.
  ForceCounts force_counts;                ///< Likewise.
  ContactSums contact_sums;                ///< Zeros from a device that does not know them.
  std::optional<ClockDrift> device_clock;  ///< Of a device with a clock of its own, in time.
  double arming_wait_s = 0.0;  ///< Until somebody may arm after the stop was released.
};

static_assert(std::is_trivially_copyable_v<Telemetry>);

}  // namespace jnd::core
