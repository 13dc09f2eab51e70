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
  Moment moment;  ///< Of the trial; the key of random numbers.
  /// Certainty of the answer, from 0 for a guess to 1; see `Perceiver::certainty_of_thicker`. 0
  /// if no answer can be right.
  double certainty_ratio = 0.0;
  /// Where the stimulus felt between the weakest and the strongest stimulus of the block, in ln
  /// of what is felt (the range principle, Parducci 1965). 0 is the weakest, 1 the strongest.
  /// Readings are noisy and may lie beyond either.
  double magnitude_ratio = 0.0;
};

/// Computes the feeling from the stored presentations of the trial's attempt. So a question
/// that is pending when a session is interrupted gets the same answer afterwards. Of several
/// looks the mean counts, and of an adjustment the last one. For a solid, the commanded
/// stiffness is felt. Otherwise it is the delivered damping plus the laboratory's mechanical
/// viscosity. `number` is that of the trial in the session. Not real time.
[[nodiscard]] TrialFeeling feeling_of(const Laboratory& laboratory,
                                      const SimulatedParticipant& participant,
                                      const Block& block, std::int64_t number,
                                      const TrialState& trial, const core::ForceMap* map);

/// Returns `magnitude_ratio` for a reading, in ln of what is felt, in this block.
[[nodiscard]] double magnitude_ratio(const Laboratory& laboratory,
                                     const SimulatedParticipant& participant,
                                     const Block& block, double reading_ln,
                                     const core::ForceMap* map);

/// Returns the place of the trial in its block, from 1, for learning and fatigue. Adaptive
/// procedures have one repetition of any length.
[[nodiscard]] std::int64_t trial_in_block(const Block& block, const PlannedTrial& trial);

}  // namespace jnd::experiments
