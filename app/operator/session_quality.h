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
  std::int64_t num_ticks = 0;  ///< The ticks while something was felt in a trial.
  /// Those of them that were due but never ran.
  std::int64_t num_missed_ticks = 0;
  int num_faults = 0;    ///< Includes stops that somebody pressed.
  int num_repeated = 0;  ///< Trials that were run more than once.
  int num_unlikely = 0;  ///< Answers that are doubtful.
  /// Trials with a stimulus that was never stroked; 0 where levels are hidden.
  int num_unstroked = 0;
  std::string problem;  ///< Why the session's log cannot be read; "" otherwise.

  /// True if somebody should look at the session.
  [[nodiscard]] bool is_doubtful() const noexcept;
};

/// Reads the log of one session. If the log is damaged, it throws nothing, and `problem` tells
/// so. With `hides_levels`, nothing is counted that movement could tell. Not real time.
[[nodiscard]] SessionQuality quality_of(const core::StudyStore& store,
                                        const core::SessionRow& row, bool hides_levels);

}  // namespace jnd::app
