#pragma once

#include <cstdint>

#include "core/media/force_map.h"
#include "experiments/participants/perceiver.h"
#include "experiments/procedures/planned_trial.h"
#include "experiments/session/session_state.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

class SimulatedParticipant;

/// What a simulated person knows of a trial that they have answered, for the questions after
/// it.
struct TrialFeeling {
  Moment moment;  ///< Of the trial; keys what is drawn.
  /// How sure they are of their answer, from 0 of a guess to 1; see
  /// `Perceiver::certainty_of_thicker`. 0 where no answer can be right.
  double certainty_ratio = 0.0;
  /// Where what they felt lies between the weakest and the strongest stimulus of the block, in
  /// ln of what is felt (the range principle, Parducci 1965): 0 is the weakest, 1 the
  /// strongest; readings are noisy and may lie beyond either.
  double magnitude_ratio = 0.0;
};

/// From the presentations of the trial's attempt as they are stored, so that a question that
/// waits when a session is interrupted is answered afterwards as it would have been before. Of
/// several looks the mean counts, of an adjustment the last. Of a solid what is felt is the
/// stiffness that was commanded, else the damping that was delivered and the laboratory's
/// mechanical viscosity. `number`: of the trial in the session. Not real time.
[[nodiscard]] TrialFeeling feeling_of(const Laboratory& laboratory,
                                      const SimulatedParticipant& participant,
                                      const Block& block, std::int64_t number,
                                      const TrialState& trial, const core::ForceMap* map);

/// `magnitude_ratio` of such a reading, in ln of what is felt, in this block.
[[nodiscard]] double magnitude_ratio(const Laboratory& laboratory,
                                     const SimulatedParticipant& participant,
                                     const Block& block, double reading_ln,
                                     const core::ForceMap* map);

/// Place of the trial in its block, from 1, for learning and fatigue. Adaptive procedures have
/// one repetition, as long as it takes.
[[nodiscard]] std::int64_t trial_in_block(const Block& block, const PlannedTrial& trial);

}  // namespace jnd::experiments
