#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/storage/study_store.h"
#include "experiments/study/study.h"

namespace jnd::app {

// What a study's folder says about the sessions that began in it.

/// The study as it was when the session began, from the store; its file may have changed since.
[[nodiscard]] experiments::Study stored_study(const core::StudyStore& store,
                                              std::int64_t session);

/// The stages of a session with these cells, in their counterbalanced order. They point into
/// `study`.
[[nodiscard]] std::vector<const experiments::Stage*> stages_of_session(
    const experiments::Study& study, const std::string& cells);

/// A sentence if the study file with which a session began has another text now; "" otherwise.
/// The session goes on with its own text.
[[nodiscard]] std::string changed_study_remark(const core::StudyStore& store,
                                               const core::SessionRow& session);

/// Throws `Error` if results may not be seen: if a session's study is double-blind and nobody
/// has unblinded the folder; or if the study plans looks, its rule has not ended it, and nobody
/// has unsealed it.
void require_results_open(const core::StudyStore& store);

/// A sentence if the rule of a sequential study has ended it, so that another session was not
/// planned; "" otherwise.
[[nodiscard]] std::string ended_study_remark(const core::StudyStore& store);

/// A sentence if the folder has sessions with another text of this study, so that no session of
/// this one can be added; "" otherwise.
[[nodiscard]] std::string other_study_problem(const core::StudyStore& store,
                                              const experiments::Study& study);

}  // namespace jnd::app
