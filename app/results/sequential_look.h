#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/storage/study_store.h"

namespace jnd::app {

/// Everything that anybody is told about a study with planned looks until its rule has ended
/// it.
struct StudyProgress {
  bool ended = false;  ///< True if the study has to stop; otherwise it goes on.
  /// Complete sessions without pilots, one for each participant.
  int num_complete = 0;
  int max_participants = 0;  ///< The number at which the study ends in any case.
  /// The number of complete sessions at the next look; 0 if there is none.
  int next_look = 0;
  bool simulated = false;
};

/// Takes, in turn, every look that is due and was not taken yet. Each uses the first so many
/// complete sessions, and its decision is stored before this returns. The decision of an
/// earlier look stays. `store` has to be open for writing. Throws `core::Error` for a study
/// without sessions or without looks.
[[nodiscard]] StudyProgress take_due_looks(core::StudyStore& store);

/// Opens the results of a study that its rule has not ended, and stores when, why, and with how
/// many complete sessions. Throws `core::Error` if the study has ended.
void unseal_study(core::StudyStore& store, const StudyProgress& progress,
                  const std::string& reason);

}  // namespace jnd::app
