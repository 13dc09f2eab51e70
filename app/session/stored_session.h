#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::app {

// What a study's folder says of the sessions that were begun in it.

/// The study as it was when the session began, from the store; its text may have changed since.
[[nodiscard]] experiments::Study stored_study(const core::StudyStore& store,
                                              std::int64_t session);

/// The stages of a session with these cells, counterbalance resolved. They point into `study`.
[[nodiscard]] std::vector<const experiments::Stage*> stages_of_session(
    const experiments::Study& study, const std::string& cells);

/// A sentence if the study file that a session was begun with holds another text by now; ""
/// otherwise. The session goes on with the text it was begun with.
[[nodiscard]] std::string changed_study_remark(const core::StudyStore& store,
                                               const core::SessionRow& session);

/// Throws `Error` where results may not be seen: a session's study is double-blind and nobody
/// has unblinded the folder, or it plans looks, its rule has not ended it and nobody has
/// unsealed it.
void require_results_open(const core::StudyStore& store);

/// A sentence if the rule of a sequential study has ended it, so that one session more was not
/// planned; "" otherwise.
[[nodiscard]] std::string ended_study_remark(const core::StudyStore& store);

/// A sentence if the folder has sessions of another text of this study, so that no session of
/// this one can be added; "" otherwise.
[[nodiscard]] std::string other_study_problem(const core::StudyStore& store,
                                              const experiments::Study& study);

}  // namespace jnd::app
