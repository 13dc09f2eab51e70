#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/progress.h"
#include "core/storage/study_store.h"

namespace jnd::core {

/// One thing found while comparing what a study should hold with what it does hold.
struct Finding {
  std::int64_t session = 0;  ///< 0: the study as a whole.
  std::string message;
};

struct Integrity {
  bool complete = true;           ///< No problem; remarks do not count.
  std::vector<Finding> problems;  ///< Something that was acknowledged is missing or damaged.
  std::vector<Finding> remarks;   ///< Losses confined to interrupted attempts, open sessions.
  std::int64_t num_sessions = 0, num_events = 0, num_trials = 0, num_samples = 0;
};

/// Checks every session: the database's own consistency, events without gaps, an answer to
/// every trial of a completed session, every presentation's ticks in the recording, every
/// chunk's hash. Reads everything, changes nothing. Not real time.
/// `progress`: by sessions.
[[nodiscard]] Integrity verify(const StudyStore& store, const Progress& progress = {});

}  // namespace jnd::core
