#include "app/operator/session_count.h"

#include <algorithm>

#include "analysis/results/block_words.h"
#include "experiments/procedures/practice.h"
#include "experiments/procedures/procedure_registry.h"

namespace jnd::app {

using namespace experiments;

SessionCount count_of_session(const SessionState& state,
                              const std::vector<const Stage*>& stages) {
  SessionCount count;
  std::vector<std::int64_t> drawn(stages.size());
  for (const TrialState& trial : state.trials) {
    if (trial.is_void || trial.stage >= std::ssize(drawn)) continue;
    ++drawn[static_cast<std::size_t>(trial.stage)];
    if (trial.is_answered) ++count.num_answers;
  }
  for (std::size_t i = 0; i < stages.size(); ++i) {
    const auto* block = std::get_if<Block>(&stages[i]->content);
    if (block == nullptr) continue;
    const auto stage = static_cast<std::int64_t>(i);
    const bool is_over = stage < state.stage && !state.is_under_way(stage);
    if (is_over) {
      count.num_trials += drawn[i];
      continue;
    }
    const bool is_open = analysis::length_is_expected(*block) || block->practice.has_value();
    count.is_expected |= is_open;
    const std::int64_t expected = expected_trials(*block);
    count.num_trials += drawn[i] == 0 ? expected
                        : is_open     ? std::max(drawn[i], expected)
                                      : drawn[i];
  }
  return count;
}

}  // namespace jnd::app
