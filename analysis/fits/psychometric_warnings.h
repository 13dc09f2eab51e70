#pragma once

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Adds what is known to make the intervals of a fit with a curve too narrow, and what its
/// value rests on where that is less than it seems. With `advice` also the options that mend
/// it, but for answers far from the curve that fall, which neither lapses nor scatter explain.
void add_psychometric_warnings(PsychometricFit& fit, const std::vector<AnswerCount>& data,
                               const PsychometricLevels& levels,
                               const PsychometricOptions& options, bool falls);

/// Whether no level has so many answers.
[[nodiscard]] bool have_fewer_answers(const PsychometricLevels& levels, double num_trials);

/// Below it bootstrap intervals are too narrow, and with a free pse those of the likelihood
/// ratio, too.
inline constexpr double kFewAnswers = 15.0;
/// Below it a calibration widens those of the likelihood ratio.
inline constexpr double kCalibratedBelow = 30.0;

/// Every answer is a yes, or every one a no: a curve through a pse that is assumed has a slope
/// nevertheless, which says nothing of the person.
[[nodiscard]] bool all_alike(const std::vector<AnswerCount>& data);
inline constexpr char kAllAlike[] =
    "every answer is the same: the Weber fraction rests on the assumed pse alone";

}  // namespace jnd::analysis
