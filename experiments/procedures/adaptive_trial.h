#pragma once

#include <vector>

#include "experiments/adaptive/level_answer.h"
#include "experiments/procedures/task.h"

namespace jnd::experiments {

// What procedures have in common that draw one trial when the one before is answered.

/// The next trial of a block, at this level of this series (from 1; 0 where there is but one);
/// or a catch trial in its place, as often as the block says. Draws whether it is one, and the
/// order of its intervals; nothing in a block that has neither.
[[nodiscard]] PlannedTrial adaptive_trial(const Block& block,
                                          const std::vector<AnsweredTrial>& answered,
                                          double level, int series, core::RandomStream& stream);

/// Levels and answers of one series, or of all trials for series 0; catch trials left out.
[[nodiscard]] std::vector<LevelAnswer> level_answers(const std::vector<AnsweredTrial>& answered,
                                                     int series = 0);

/// So many trials with the catch trials among them.
[[nodiscard]] int with_catch_trials(const Block& block, int num_trials) noexcept;

/// Their keys that are the same to all: task, reference, catch trials, labels of the answers.
[[nodiscard]] std::vector<BlockKey> adaptive_keys();

/// Which end of the levels a "yes" belongs to, and in which scale levels are stepped.
[[nodiscard]] BlockKey scale_key();

}  // namespace jnd::experiments
