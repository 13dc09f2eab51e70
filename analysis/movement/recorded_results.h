#pragma once

#include "analysis/movement/movement_analysis.h"
#include "analysis/results/study_results.h"

namespace jnd::analysis {

/// The results that the recordings add to `movement_results`, over participants and by block:
/// speed, duration, pauses and energy of strokes, the height of the hand, delivered over
/// commanded force, and the share of flawed presentations. They include the difference between
/// successive blocks, and whether tall people make other strokes.
[[nodiscard]] ResultsSection recorded_results(const MovementAnalysis& movement);

}  // namespace jnd::analysis
