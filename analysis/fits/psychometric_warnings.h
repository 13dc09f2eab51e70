#pragma once

#include "analysis/fits/psychometric_model.h"

namespace jnd::analysis {

/// Adds warnings about what makes the intervals of a fit too narrow, and about values that rest
/// on less than they seem to. With `advice` they also name the options that help. They name
/// none if answers lie far from the curve because they fall, since neither lapses nor scatter
/// explain that.
void add_psychometric_warnings(PsychometricFit& fit, const std::vector<AnswerCount>& data,
                               const PsychometricLevels& levels,
                               const PsychometricOptions& options, bool falls);

/// Whether every level has fewer than `num_trials` answers.
[[nodiscard]] bool have_fewer_answers(const PsychometricLevels& levels, double num_trials);

/// Below this number of answers at a level, bootstrap intervals are too narrow. With a free
/// pse, likelihood-ratio intervals are too narrow as well.
inline constexpr double kFewAnswers = 15.0;
/// Below this number of answers at a level, a calibration widens likelihood-ratio intervals.
inline constexpr double kCalibratedBelow = 30.0;

/// Whether every answer is a yes, or every answer is a no. A curve through an assumed pse then
/// still has a slope, but the slope says nothing about the person.
[[nodiscard]] bool all_alike(const std::vector<AnswerCount>& data);
inline constexpr char kAllAlike[] =
    "every answer is the same: the Weber fraction rests on the assumed pse alone";

}  // namespace jnd::analysis
