#pragma once

#include "core/storage/integrity.h"
#include "core/storage/study_store.h"

namespace jnd::app {

/// Plays every session's log again and compares what it comes to with the rows that analyses
/// read: drawn trials, presentations, answers, exclusions. Adds what does not agree to
/// `integrity`. Not real time.
/// `progress`: by sessions.
void check_replay(const core::StudyStore& store, core::Integrity& integrity,
                  const core::Progress& progress = {});

}  // namespace jnd::app
