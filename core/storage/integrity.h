#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/storage/study_store.h"

namespace jnd::core {

/// One difference between what a study should hold and what it holds.
struct Finding {
  std::int64_t session = 0;  ///< 0 means the study as a whole.
  std::string message;
};

struct Integrity {
  bool complete = true;           ///< There is no problem; remarks do not count.
  std::vector<Finding> problems;  ///< Something that was acknowledged is missing or damaged.
  /// Losses that affect only interrupted attempts and open sessions.
  std::vector<Finding> remarks;
  std::int64_t num_sessions = 0, num_events = 0, num_trials = 0, num_samples = 0;
};

/// Checks every session: the database's own consistency, that events have no gaps, that every
/// trial of a completed session has an answer, that the recording holds the ticks of every
/// presentation, and the hash of every chunk. It reads everything and changes nothing.
/// `progress` counts sessions. Not real time.
[[nodiscard]] Integrity verify(const StudyStore& store, const Progress& progress = {});

}  // namespace jnd::core
