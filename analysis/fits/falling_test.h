#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// Whether answers fall as the intensity grows, as of somebody who has the question the wrong
/// way round: the exact trend test of Cochran (1954) and Armitage (1955), one-sided, with the
/// ranks of the intensities as scores. The p value is the probability that as many "yes" lie as
/// low or lower, were every placement of them over the trials of their order of the intervals
/// equally likely (as in Fisher's exact test, which it is at two levels); beyond 200 trials
/// that of the normal distribution with the exact mean and variance. Absent where nothing can
/// fall: fewer than two levels, or answers all alike. Where answers choose the levels, "yes"
/// tends to be followed by lower ones, so that answers at random seem to rise: the test then
/// finds too few. Not real time.
[[nodiscard]] std::optional<double> falling_p_value(const std::vector<AnswerCount>& rows);

/// Answers whose p value is less are said to fall.
inline constexpr double kFallingBelow = 0.01;

/// The p value where the answers fall.
[[nodiscard]] std::optional<double> significant_fall(const std::vector<AnswerCount>& rows);

/// "p = 0.004", "p < 0.001"
[[nodiscard]] std::string falling_p_words(double p_value);

/// "the answers fall as the intensity grows (exact trend test, p = 0.004), as of somebody who
/// answers the wrong way round".
[[nodiscard]] std::string falling_words(double p_value);

/// The same as a note on a fit of these answers, with what to do.
[[nodiscard]] std::string falling_warning(double p_value);

}  // namespace jnd::analysis
