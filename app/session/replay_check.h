#pragma once

#include "core/storage/integrity.h"
#include "core/storage/study_store.h"

namespace jnd::app {

/// Replays every session's log and compares the result with the rows that analyses read: drawn
/// trials, presentations, answers, exclusions. Adds what does not agree to `integrity`.
/// `progress` is told after each session. Not real time.
void check_replay(const core::StudyStore& store, core::Integrity& integrity,
                  const core::Progress& progress = {});

}  // namespace jnd::app
