#pragma once

#include "analysis/movement/movement_analysis.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// What the recordings add to `movement_results`: speed, duration, pauses and energy of
/// strokes, height of the hand, delivered over commanded force and the share of marked
/// presentations, over participants, by block, with the difference of blocks that follow one
/// another; and whether tall people stroke otherwise.
[[nodiscard]] ResultsSection recorded_results(const MovementAnalysis& movement);

}  // namespace jnd::analysis
