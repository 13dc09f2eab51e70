#pragma once

#include <array>
#include <cstdint>

#include "core/haptic_state.h"

namespace jnd::core {

/// Finds measurements that are not new: a clock of the device that stands still, or positions
/// that do while the velocity says that the hand moves. Either is excused for `max_ticks`, in
/// which an older measurement may stand in for one that is missing. Ticks that the loop missed
/// count: a measurement grows old while nobody looks at it. Real time.
class Staleness {
 public:
  /// Allows `max_ticks` >= 0 ticks of `period_s` without anything new.
  Staleness(std::int64_t max_ticks, double period_s) noexcept
      : max_ticks_(max_ticks), period_s_(period_s) {}

  /// Takes one tick. `elapsed_s` is the time since `last` by the device's clock, and
  /// `num_missed` the number of ticks that the loop missed before this one.
  void observe(const HapticState& state, const HapticState& last, double elapsed_s,
               std::int64_t num_missed) noexcept;

  [[nodiscard]] bool is_stale() const noexcept { return is_stuck_ || num_still_ > max_ticks_; }
  /// Whether the loop missed ticks in the meantime. Then it cannot tell whether the device kept
  /// time.
  [[nodiscard]] bool may_be_the_loops() const noexcept { return num_missed_ > 0; }
  /// Returns the longest time for which a measurement may be reused.
  [[nodiscard]] double longest_s() const noexcept {
    return static_cast<double>(max_ticks_ + 1) * period_s_;
  }

  /// Forgets everything but the ticks that the loop missed.
  void reset() noexcept;

 private:
  [[nodiscard]] bool moves_without_getting_anywhere(const HapticState& state,
                                                    const HapticState& last, double elapsed_s,
                                                    std::int64_t num_missed) noexcept;

  std::int64_t max_ticks_;
  double period_s_;
  bool is_stuck_ = false;
  std::int64_t num_still_ = 0;   ///< Ticks without time passing, missed ones among them.
  std::int64_t num_stuck_ = 0;   ///< Ticks with a velocity and no way, likewise.
  std::int64_t num_missed_ = 0;  ///< By the loop, since either began.
  /// That each point says it has moved while its position stood still.
  std::array<double, kNumContactPoints> stuck_way_m_{};
};

}  // namespace jnd::core
