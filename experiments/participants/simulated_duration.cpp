#include "experiments/participants/simulated_duration.h"

#include <algorithm>
#include <variant>

#include "experiments/procedures/practice.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/session/session.h"

namespace jnd::experiments {

/// Practice does not count, because it uses easy stimuli and gives no threshold.
static void count_ends(const Block& block, const std::vector<AnsweredTrial>& trials,
                       SimulatedBlock& done) {
  if (block.practice) return;
  const std::vector<double> possible =
      procedure_named(block.procedure).possible_intensities(block);
  if (possible.empty()) return;
  const auto [lowest, highest] = std::ranges::minmax(possible);
  for (const AnsweredTrial& trial : trials) {
    done.num_at_lowest += trial.planned.intensity == lowest ? 1 : 0;
    done.num_at_highest += trial.planned.intensity == highest ? 1 : 0;
  }
}

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
    count_ends(block, answered.trials, done);
  }
  return simulated;
}

}  // namespace jnd::experiments
