#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "analysis/movement/force_by_speed.h"
#include "analysis/movement/recorded_strokes.h"

namespace jnd::analysis {

/// Flaws of a movement, as numbers of ticks. All are 0 for a movement without flaws.
struct MovementMarks {
  /// Ticks that are missing from the recording. Nothing replaces them.
  std::int64_t missing_ticks = 0;
  /// Ticks at which a point that had held the hand did not hold it.
  std::int64_t lost_contact_ticks = 0;
  /// Ticks at which the force limiter changed the force (saturation).
  std::int64_t limited_ticks = 0;
  /// Ticks at which a fault was latched, so there was no force.
  std::int64_t fault_ticks = 0;

  [[nodiscard]] bool any() const noexcept {
    return missing_ticks > 0 || lost_contact_ticks > 0 || limited_ticks > 0 || fault_ticks > 0;
  }
  void add(const MovementMarks& other) noexcept {
    missing_ticks += other.missing_ticks;
    lost_contact_ticks += other.lost_contact_ticks;
    limited_ticks += other.limited_ticks;
    fault_ticks += other.fault_ticks;
  }
};

/// One presentation: its identity, and how the hand moved, from the samples. Strokes, height
/// and force cover the time after the ramp.
struct PresentationMovement {
  std::int64_t session = 0, trial = 0, attempt = 0, presentation = 0;
  /// The block; "" for a medium explored outside of trials, for which trial is 0.
  std::string block;
  std::string medium;    ///< For example "viscous", "water" or "free_space".
  std::string interval;  ///< "test", "reference" or "free_space"; "explored" outside of trials.
  std::int64_t repetition = 0;
  double intensity = 0.0;
  std::int64_t first_tick = 0, last_tick = 0;
  StrokeMeans strokes;  ///< Means over strokes without gap, lost contact and fault.
  std::optional<double> mean_height_m;  ///< The mean height of the hand in the workspace frame.
  DeliveredForce force;
  MovementMarks marks;
};

}  // namespace jnd::analysis
