#pragma once

#include <vector>

#include "experiments/adaptive/level_answer.h"
#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

// What procedures have in common that draw one trial when the one before is answered.

/// Their form: yes or no, about the test against a reference or alone.
[[nodiscard]] TrialForm adaptive_form(const Block& block);

/// The next trial of a block after `num_answered`, at this level of this series (from 1; 0
/// where there is but one).
[[nodiscard]] PlannedTrial adaptive_trial(const Block& block, std::size_t num_answered,
                                          double level, int series = 0);

/// Levels and answers of one series, or of all trials for series 0; catch trials left out.
[[nodiscard]] std::vector<LevelAnswer> level_answers(const std::vector<AnsweredTrial>& answered,
                                                     int series = 0);

/// Their keys that are the same to all: task, reference, labels of the answers.
[[nodiscard]] std::vector<BlockKey> adaptive_keys();

/// Which end of the levels a "yes" belongs to, and in which scale levels are stepped.
[[nodiscard]] BlockKey scale_key();

}  // namespace jnd::experiments
