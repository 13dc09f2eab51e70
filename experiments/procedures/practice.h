#pragma once

#include <string>
#include <vector>

#include "experiments/procedures/procedure.h"

namespace jnd::experiments {

/// What the answers of a practice block have come to.
struct PracticeState {
  int num_trials = 0;
  int num_judged = 0;   ///< The last answers that could be right, at most as many as count.
  int num_correct = 0;  ///< Right answers among those judged.
  bool criterion_is_met = false;
  bool is_over = false;  ///< It is met, or there were as many trials as there may be.
};

/// Throws `std::bad_optional_access` for a block that is no practice.
[[nodiscard]] PracticeState practice_state(const Block& block,
                                           const std::vector<AnsweredTrial>& answered);

/// "practice over after 14 trials: 8 of the last 10 answers were right, at least 8 were
/// asked for", in one sentence without a full stop; "practice broken off after 3 trials: ..."
/// where it is not over.
[[nodiscard]] std::string practice_words(const Block& block, const PracticeState& state);

/// What a session runs next: the trials that the block's procedure draws, none once a practice
/// is over. Throws what `draw_next` throws.
[[nodiscard]] std::vector<PlannedTrial> next_trials(const Block& block,
                                                    const std::vector<AnsweredTrial>& answered,
                                                    core::RandomStream& stream);

/// How many trials to expect of the block, at most those of a practice.
[[nodiscard]] int expected_trials(const Block& block);
/// How many there can be, with as many catch trials as are to be expected among them.
[[nodiscard]] int most_trials(const Block& block);
/// "about 60" where the procedure adapts, "at most 40" of a practice, else "50".
[[nodiscard]] std::string expected_trials_words(const Block& block);

}  // namespace jnd::experiments
