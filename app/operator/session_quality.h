#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::app {

/// How well a session went, in counts. None of them tells a level, an order or an arm.
struct SessionQuality {
  std::int64_t session = 0;
  std::string participant;
  bool pilot = false;
  std::int64_t num_ticks = 0;         ///< While something was felt in a trial.
  std::int64_t num_missed_ticks = 0;  ///< Of them, due and never run.
  int num_faults = 0;                 ///< Stops that somebody pressed among them.
  int num_repeated = 0;               ///< Trials that were run more than once.
  int num_unlikely = 0;               ///< Answers that something speaks against.
  int num_unstroked = 0;  ///< Trials with a stimulus that was never stroked; 0 where hidden.
  int num_without_force = 0;  ///< Presentations in which none acted, though one was asked for.
  std::string problem;        ///< Why its log cannot be read; "" where it can.

  /// True if somebody should look at the session.
  [[nodiscard]] bool is_doubtful() const noexcept;
};

/// Reads the log of one session. If the log is damaged, it throws nothing, and `problem` tells
/// so. With `hides_levels`, nothing is counted that movement could tell. Not real time.
[[nodiscard]] SessionQuality quality_of(const core::StudyStore& store,
                                        const core::SessionRow& row, bool hides_levels);

}  // namespace jnd::app
