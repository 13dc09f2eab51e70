#include "experiments/procedures/practice.h"

#include <algorithm>
#include <cmath>

#include "experiments/procedures/procedure_registry.h"

namespace jnd::experiments {
namespace {

int num_correct_needed(const Practice& practice) {
  constexpr double kRounding = 1e-9;  // 0.7 of 10 is 7, whatever the last digit of the product.
  return static_cast<int>(
      std::ceil(practice.min_correct_ratio * practice.num_trials_judged - kRounding));
}

}  // namespace

PracticeState practice_state(const Block& block, const std::vector<AnsweredTrial>& answered) {
  const Practice& practice = block.practice.value();
  const Procedure& procedure = procedure_named(block.procedure);
  PracticeState state{.num_trials = static_cast<int>(answered.size())};
  for (std::size_t i = answered.size(); i > 0; --i) {
    if (state.num_judged == practice.num_trials_judged) break;
    const AnsweredTrial& trial = answered[i - 1];
    const std::optional<double> right = procedure.right_response(block, trial.planned);
    if (!right) continue;
    ++state.num_judged;
    state.num_correct += trial.response == *right ? 1 : 0;
  }
  state.criterion_is_met = state.num_judged == practice.num_trials_judged &&
                           state.num_correct >= num_correct_needed(practice);
  state.is_over = state.criterion_is_met || state.num_trials >= practice.max_trials;
  return state;
}

std::string practice_words(const Block& block, const PracticeState& state) {
  const Practice& practice = block.practice.value();
  const int num_needed = num_correct_needed(practice);
  const std::string of_judged =
      state.is_over ? "" : " of " + std::to_string(practice.num_trials_judged);
  return std::string("practice ") + (state.is_over ? "over" : "broken off") + " after " +
         std::to_string(state.num_trials) + (state.num_trials == 1 ? " trial: " : " trials: ") +
         std::to_string(state.num_correct) + " of the last " +
         std::to_string(state.num_judged) + " answers were right, at least " +
         std::to_string(num_needed) + of_judged + (num_needed == 1 ? " was" : " were") +
         " asked for";
}

std::vector<PlannedTrial> next_trials(const Block& block,
                                      const std::vector<AnsweredTrial>& answered,
                                      core::RandomStream& stream) {
  if (block.practice && practice_state(block, answered).is_over) return {};
  return procedure_named(block.procedure).draw_next(block, answered, stream);
}

int expected_trials(const Block& block) {
  const int expected = procedure_named(block.procedure).expected_trials(block);
  return block.practice ? std::min(expected, block.practice->max_trials) : expected;
}

int most_trials(const Block& block) {
  const int most = procedure_named(block.procedure).most_trials(block);
  return block.practice ? std::min(most, block.practice->max_trials) : most;
}

std::string expected_trials_words(const Block& block) {
  const bool adapts = procedure_named(block.procedure).adapts();
  return (block.practice ? "at most "
          : adapts       ? "about "
                         : "") +
         std::to_string(expected_trials(block));
}

}  // namespace jnd::experiments
