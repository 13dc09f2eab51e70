#include "experiments/participants/simulated_duration.h"

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
    simulated.duration_s += (num_trials - expected_trials(block)) *
                            (block.free_space_between_s + block.expected_trial_s);
    simulated.num_trials[answered.stage->name] += num_trials;
  }
  return simulated;
}

}  // namespace jnd::experiments
