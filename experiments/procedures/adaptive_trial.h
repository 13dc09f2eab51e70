#pragma once

#include <vector>

#include "experiments/adaptive/level_answer.h"
#include "experiments/procedures/task.h"

namespace jnd::experiments {

// Common functions of procedures that draw one trial after each answer.

/// Returns the next trial of a block, at this level of this series (from 1; 0 if there is only
/// one), or a catch trial in its place, as often as the block says. It draws whether the trial
/// is a catch trial, and the order of its intervals. It draws nothing in a block without
/// either.
[[nodiscard]] PlannedTrial adaptive_trial(const Block& block,
                                          const std::vector<AnsweredTrial>& answered,
                                          double level, int series, core::RandomStream& stream);

/// Returns levels and answers of one series, or of all trials for series 0. Catch trials are
/// left out.
[[nodiscard]] std::vector<LevelAnswer> level_answers(const std::vector<AnsweredTrial>& answered,
                                                     int series = 0);

/// Returns the number of trials including the expected catch trials.
[[nodiscard]] int with_catch_trials(const Block& block, int num_trials) noexcept;

/// Returns the keys that all of these procedures have: task, reference, catch trials, labels of
/// the answers.
[[nodiscard]] std::vector<BlockKey> adaptive_keys();

/// Returns the key that says in which scale levels are stepped.
[[nodiscard]] BlockKey scale_key();

}  // namespace jnd::experiments
