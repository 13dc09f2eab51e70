#pragma once

#include <optional>
#include <vector>

#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// A p value below this limit says that answers scatter more than chance explains.
inline constexpr double kScatterBelow = 0.01;

/// Pearson's chi-squared, with its degrees of freedom, for the differences between rows that
/// were asked the same question. The values of two independent sets of rows may be added.
struct RowScatter {
  double statistic = 0.0;
  int degrees_of_freedom = 0;

  RowScatter& operator+=(const RowScatter& other) noexcept;
  /// The p value is absent where no two rows asked the same question.
  [[nodiscard]] std::optional<double> p_value() const;
  /// The p value is less than `kScatterBelow`.
  [[nodiscard]] bool is_significant() const;
};

/// Compares rows that have the same level and the same order of the intervals. Answers of one
/// row may have more in common than answers of two rows, because they come from one person or
/// one session. Rows of a single answer are pooled before they are compared. If their sequence
/// tells when they were given (levels alternate), each quarter of them counts as one row per
/// level. Otherwise all single answers to a level count as one row.
[[nodiscard]] RowScatter row_scatter(const std::vector<AnswerCount>& rows);

/// Answers to one level, and the probability of a yes that a fitted curve predicts there.
struct FittedAnswers {
  double num_yes = 0.0, num_trials = 0.0;
  double probability = 0.0;
};

/// The probability that answers which follow the fitted curve lie as far from it as these do,
/// measured by their deviance. The function computes the exact mean and variance of the
/// deviance for binomial answers, because chi-squared does not describe it when a level has few
/// answers. Levels of a single answer are grouped in tens, by neighbouring probability; fewer
/// than ten of them are left out. The mean is reduced by `num_fitted`, the number of parameters
/// that were fitted to the answers. The deviance is taken to have a gamma distribution with
/// this mean; chi-squared is one such distribution. The value is absent if less than one degree
/// of freedom is left. Not real time.
[[nodiscard]] std::optional<double> misfit_p_value(const std::vector<FittedAnswers>& answers,
                                                   double num_fitted);

}  // namespace jnd::analysis
