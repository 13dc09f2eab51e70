#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::analysis {

/// How punctual a session's loop was, over all its starts.
struct SessionTiming {
  std::int64_t num_ticks = 0, missed_ticks = 0, num_dropped_samples = 0;
  std::optional<double> lateness_p99_s;  ///< Upper end of the bucket that holds it.
  double max_lateness_s = 0.0;
};

/// What is to be known of a session's data before they are believed.
struct SessionQuality {
  core::SessionRow session;
  bool completed = false;
  std::string ended_early;        ///< Why, if it was; "" otherwise.
  std::int64_t num_drawn = 0;     ///< Trials of the design.
  std::int64_t num_answered = 0;  ///< That stand and count.
  std::int64_t num_excluded = 0;  ///< Answered, but set aside.
  std::int64_t num_undone = 0, num_corrected = 0, num_discarded = 0;
  std::int64_t num_resumed = 0, num_paused = 0, num_faults = 0;
  std::int64_t num_presentations = 0;
  std::int64_t num_limited = 0;     ///< Presentations in which the limiter changed the force.
  std::int64_t num_strokeless = 0;  ///< Presentations of stimuli without a whole stroke.
  double duration_s = 0.0;          ///< From the first event to the last of the visit.
  std::optional<SessionTiming> timing;        ///< Absent where ticks had no due time.
  std::optional<std::int64_t> missing_ticks;  ///< Of the recording; absent without one.
  std::vector<std::string> remarks;           ///< Exclusions and why, faults, notes ...

  [[nodiscard]] std::int64_t num_missing() const {
    return num_drawn - num_answered - num_excluded;
  }
};

/// The quality of these sessions, in their order. Throws `Error` for a damaged study; a
/// recording that cannot be read is a remark.
[[nodiscard]] std::vector<SessionQuality> session_quality(
    const core::StudyStore& store, const std::vector<core::SessionRow>& sessions);

/// SHA-256 over everything that these sessions' logs hold: the same for every copy of the
/// study, however many sessions ran at once.
[[nodiscard]] std::string data_sha256(const core::StudyStore& store,
                                      const std::vector<core::SessionRow>& sessions);

}  // namespace jnd::analysis
