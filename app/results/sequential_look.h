#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::app {

/// All that anybody is told of a study that plans looks, before its rule has ended it.
struct StudyProgress {
  bool ended = false;        ///< Stop. Otherwise go on.
  int num_complete = 0;      ///< Complete sessions, one a participant; no pilots.
  int max_participants = 0;  ///< At which the study ends in any case.
  int next_look = 0;         ///< Complete sessions at the next look; 0 where there is none.
  bool simulated = false;
};

/// Takes every look that enough people are there for and that was not taken, in turn, each of
/// the first so many complete sessions, and keeps what it came to before it returns. A look
/// that was taken stays as it was told. `store` has to be open for writing. Throws
/// `core::Error` for a study without sessions or without looks.
[[nodiscard]] StudyProgress take_due_looks(core::StudyStore& store);

/// Opens the results of a study that its rule has not ended, and keeps when, with how many
/// complete sessions and why. Throws `core::Error` where it has ended.
void unseal_study(core::StudyStore& store, const StudyProgress& progress,
                  const std::string& reason);

}  // namespace jnd::app
