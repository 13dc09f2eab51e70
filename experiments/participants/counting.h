#pragma once

#include "core/media/force_map.h"
#include "experiments/participants/simulated_participant.h"

namespace jnd::experiments {

/// Returns how the numbers of an estimation count for this person in this trial.
/// `felt_standard_ln` is the mean reading of the standard if it was felt in the trial.
/// Otherwise the standard is remembered without noise: as its calculated stroke
/// (`calculated_stroke`) plus the laboratory's mechanical viscosity, or as a solid's stiffness.
[[nodiscard]] Counting counting_of(const Laboratory& laboratory,
                                   const SimulatedParticipant& participant, const Block& block,
                                   std::optional<double> felt_standard_ln,
                                   const core::ForceMap* map = nullptr);

}  // namespace jnd::experiments
