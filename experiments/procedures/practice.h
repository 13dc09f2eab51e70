#pragma once

#include <string>
#include <vector>

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// The state of a practice block after some answers.
struct PracticeState {
  int num_trials = 0;
  /// Number of judged answers: the last ones that could be right, at most as many as the
  /// practice judges.
  int num_judged = 0;
  int num_correct = 0;  ///< Right answers among those judged.
  bool criterion_is_met = false;
  bool is_over = false;  ///< The criterion is met, or the largest number of trials was reached.
};

/// Throws `std::bad_optional_access` for a block that is no practice.
[[nodiscard]] PracticeState practice_state(const Block& block,
                                           const std::vector<AnsweredTrial>& answered);

/// Returns one sentence without a full stop: "practice over after 14 trials: 8 of the last 10
/// answers were right, at least 8 were asked for"; if it is not over, "practice broken off
/// after 3 trials: ...".
[[nodiscard]] std::string practice_words(const Block& block, const PracticeState& state);

/// Returns the trials that a session runs next: those that the block's procedure draws, or none
/// once a practice is over. Throws what `draw_next` throws.
[[nodiscard]] std::vector<PlannedTrial> next_trials(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream);

/// Returns how many trials to expect of the block, at most those of a practice.
[[nodiscard]] int expected_trials(const Block& block);
/// Returns the largest number of trials, including the expected number of catch trials.
[[nodiscard]] int most_trials(const Block& block);
/// Returns "about 60" if the procedure adapts, "at most 40" for a practice, and otherwise "50".
[[nodiscard]] std::string expected_trials_words(const Block& block);

}  // namespace jnd::experiments
