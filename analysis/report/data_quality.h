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
  /// The upper end of the bucket that holds the 99th percentile.
  std::optional<double> lateness_p99_s;
  double max_lateness_s = 0.0;
};

/// What must be known about a session's data before they are trusted.
struct SessionQuality {
  core::SessionRow session;
  bool completed = false;
  std::string ended_early;        ///< The reason if it was ended early; "" otherwise.
  std::int64_t num_drawn = 0;     ///< The number of trials in the design.
  std::int64_t num_answered = 0;  ///< The number of valid answers.
  std::int64_t num_excluded = 0;  ///< The number of answers that were set aside.
  std::int64_t num_undone = 0, num_corrected = 0, num_discarded = 0;
  std::int64_t num_resumed = 0, num_paused = 0, num_faults = 0;
  std::int64_t num_presentations = 0;
  /// The number of presentations in which the limiter changed the force.
  std::int64_t num_limited = 0;
  /// The number of presentations of stimuli without a whole stroke.
  std::int64_t num_strokeless = 0;
  /// The time from the first event to the last event of the visit.
  double duration_s = 0.0;
  std::optional<SessionTiming> timing;  ///< Absent if ticks had no due time.
  /// The number of ticks missing from the recording; absent without a recording.
  std::optional<std::int64_t> missing_ticks;
  /// Exclusions with their reasons, faults, notes and so on.
  std::vector<std::string> remarks;

  [[nodiscard]] std::int64_t num_missing() const {
    return num_drawn - num_answered - num_excluded;
  }
};

/// The quality of these sessions, in their order. Throws `Error` for a damaged study. A
/// recording that cannot be read becomes a remark.
[[nodiscard]] std::vector<SessionQuality> session_quality(
    const core::StudyStore& store, const std::vector<core::SessionRow>& sessions);

/// The SHA-256 of everything in these sessions' logs. It is the same for every copy of the
/// study, however many sessions ran at once.
[[nodiscard]] std::string data_sha256(const core::StudyStore& store,
                                      const std::vector<core::SessionRow>& sessions);

}  // namespace jnd::analysis
