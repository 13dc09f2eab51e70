#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "analysis/movement/force_by_speed.h"
#include "analysis/movement/recorded_strokes.h"

namespace jnd::analysis {

/// Why a movement is not quite what it should be. Ticks are counted; all 0 is a clean one.
struct MovementMarks {
  std::int64_t missing_ticks = 0;       ///< Not in the recording; nothing stands in for them.
  std::int64_t lost_contact_ticks = 0;  ///< A point that held the hand before did not.
  std::int64_t limited_ticks = 0;       ///< The force limiter changed the force: saturation.
  std::int64_t fault_ticks = 0;         ///< A fault was latched: no force.

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

/// One presentation: which one it is, and how the hand moved in it, from its samples. Strokes,
/// height and force are of the time after the ramp.
struct PresentationMovement {
  std::int64_t session = 0, trial = 0, attempt = 0, presentation = 0;
  std::string block;     ///< "" for a medium explored outside of trials; trial is 0 then.
  std::string medium;    ///< "viscous", "water", "free_space" ...
  std::string interval;  ///< "test", "reference", "free_space"; "explored" outside of trials.
  std::int64_t repetition = 0;
  double intensity = 0.0;
  std::int64_t first_tick = 0, last_tick = 0;
  StrokeMeans strokes;  ///< Means over strokes without gap, lost contact, fault.
  std::optional<double> mean_height_m;  ///< Mean height of the hand, workspace frame.
  DeliveredForce force;
  MovementMarks marks;
};

}  // namespace jnd::analysis
