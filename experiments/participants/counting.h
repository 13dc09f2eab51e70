#pragma once

#include "core/media/force_map.h"
#include "experiments/participants/simulated_participant.h"

namespace jnd::experiments {

/// How the numbers of an estimation count for this person in this trial. `felt_standard_ln`:
/// the mean reading of the standard where it was felt in the trial; elsewhere it is remembered
/// as what it is, without noise: its calculated stroke (`calculated_stroke`) and the
/// laboratory's mechanical viscosity, or a solid's stiffness.
[[nodiscard]] Counting counting_of(const Laboratory& laboratory,
                                   const SimulatedParticipant& participant, const Block& block,
                                   std::optional<double> felt_standard_ln,
                                   const core::ForceMap* map = nullptr);

}  // namespace jnd::experiments
