#include "experiments/participants/simulated_duration.h"

#include <algorithm>
#include <variant>

#include "experiments/procedures/practice.h"
#include "experiments/session/session.h"

namespace jnd::experiments {

SimulatedDuration simulated_duration(const ParticipantPlan& plan,
                                     const AnswerSimulator& simulator, const Study& study,
                                     std::uint64_t seed) {
  SimulatedDuration simulated{.duration_s = plan.duration_s};
  for (const AnsweredBlock& answered :
       simulator.answers(plan.stages, session_seed(seed, study.name, plan.participant))) {
    const auto& block = std::get<Block>(answered.stage->content);
    const auto num_trials = static_cast<int>(answered.trials.size());
    const double expected_s =
        expected_trials(block) * (block.free_space_between_s + block.expected_trial_s);
    const double trials_s = std::max(num_trials * block.expected_trial_s, answered.felt_s);
    simulated.duration_s += num_trials * block.free_space_between_s + trials_s - expected_s;
    SimulatedBlock& done = simulated.blocks[answered.stage->name];
    done.num_trials += num_trials;
    done.felt_s += answered.felt_s;
  }
  return simulated;
}

}  // namespace jnd::experiments
