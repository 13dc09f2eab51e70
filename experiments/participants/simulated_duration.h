#pragma once

#include <map>
#include <string>

#include "experiments/participants/answer_simulator.h"
#include "experiments/session/plan.h"

namespace jnd::experiments {

/// What a simulated participant did in one block.
struct SimulatedBlock {
  int num_trials = 0;
  double felt_s = 0.0;  ///< Duration of all presentations.
  /// Trials with the lowest and with the highest possible stimulus.
  int num_at_lowest = 0, num_at_highest = 0;
};

/// How long a simulated participant takes, and for which blocks.
struct SimulatedDuration {
  double duration_s = 0.0;
  std::map<std::string, SimulatedBlock> blocks;  ///< By the name of the stage.
};

/// Computes the plan's expected duration, with the trials that a simulated participant of this
/// plan does instead of the expected ones. So it differs between persons if a procedure adapts
/// to them. A block's trials take the time that the study expects, but no less than their
/// presentations, because an adjustment takes as many looks as it needs. `seed` is that of the
/// study. Not real time.
[[nodiscard]] SimulatedDuration simulated_duration(const ParticipantPlan& plan,
                                                   const AnswerSimulator& simulator,
                                                   const Study& study, std::uint64_t seed);

}  // namespace jnd::experiments
