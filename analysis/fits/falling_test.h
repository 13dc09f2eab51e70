#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// Tests whether answers fall as the intensity grows, which happens if a person answers the
/// question the wrong way round. It is the exact one-sided trend test of Cochran (1954) and
/// Armitage (1955), with the ranks of the intensities as scores. The p value is the probability
/// that as many "yes" lie at such low intensities or lower, if every placement of them over the
/// trials with the same order of intervals is equally likely. At two levels it is Fisher's
/// exact test. Above 200 trials the function uses the normal distribution with the exact mean
/// and variance. The value is absent if nothing can fall: there are fewer than two levels, or
/// all answers are alike. Where the answers choose the levels, "yes" tends to be followed by
/// lower levels, so random answers seem to rise and the test finds too few falls.
/// Not real time.
[[nodiscard]] std::optional<double> falling_p_value(const std::vector<AnswerCount>& rows);

/// Answers are reported to fall if the p value is below this limit.
inline constexpr double kFallingBelow = 0.01;

/// The p value, present only if it is below the limit.
[[nodiscard]] std::optional<double> significant_fall(const std::vector<AnswerCount>& rows);

/// For example "p = 0.004" or "p < 0.001".
[[nodiscard]] std::string falling_p_words(double p_value);

/// For example "the answers fall as the intensity grows (exact trend test, p = 0.004), as of
/// somebody who answers the wrong way round".
[[nodiscard]] std::string falling_words(double p_value);

/// A note on a fit of these answers, which also says what to do.
[[nodiscard]] std::string falling_warning(double p_value);

}  // namespace jnd::analysis
