#pragma once

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Adds what is known to make the intervals of a fit with a curve too narrow, and what its
/// value rests on where that is less than it seems. With `advice` also the options that mend
/// it, but for answers far from the curve that fall, which neither lapses nor scatter explain.
/// `degrees_of_freedom`: of the deviance.
void add_psychometric_warnings(PsychometricFit& fit, const std::vector<AnswerCount>& data,
                               const PsychometricLevels& levels,
                               const PsychometricOptions& options, int degrees_of_freedom,
                               bool falls);

}  // namespace jnd::analysis
