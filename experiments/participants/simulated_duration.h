#pragma once

#include <map>
#include <string>
#include <vector>

#include "experiments/participants/answer_simulator.h"
#include "experiments/session/plan.h"

namespace jnd::experiments {

/// How long a simulated participant takes, and how many trials each block.
struct SimulatedDuration {
  double duration_s = 0.0;
  std::map<std::string, int> num_trials;  ///< Name of the block's stage to its trials.
};

/// The plan's expectation, with the trials that a simulated participant of this plan does in
/// place of those expected: so it differs between persons where a procedure adapts to them. A
/// trial takes the time that the study expects. `seed`: of the study. Not real time.
[[nodiscard]] SimulatedDuration simulated_duration(const ParticipantPlan& plan,
                                                   const AnswerSimulator& simulator,
                                                   const Study& study, std::uint64_t seed);

}  // namespace jnd::experiments
