#pragma once

#include <optional>
#include <vector>

#include "analysis/fits/psychometric_fit.h"

namespace jnd::analysis {

/// Answers that scatter so, or more, are as rare as this where nothing but chance is at work.
inline constexpr double kScatterBelow = 0.01;

/// Pearson's chi-squared of how rows that ask the same differ, over their degrees of freedom.
/// Those of two independent sets of rows may be added up.
struct RowScatter {
  double statistic = 0.0;
  int degrees_of_freedom = 0;

  RowScatter& operator+=(const RowScatter& other) noexcept;
  /// Absent where no two rows ask the same.
  [[nodiscard]] std::optional<double> p_value() const;
  /// The p value is less than `kScatterBelow`.
  [[nodiscard]] bool is_significant() const;
};

/// Of rows of one level and one order of the intervals. Answers of one row may have more in
/// common than those of two, such as a person or a session. Of rows of a single answer each
/// quarter counts as one row a level, if their order tells when they were given: levels follow
/// each other in turn; else all of a level do.
[[nodiscard]] RowScatter row_scatter(const std::vector<AnswerCount>& rows);

/// Answers, and the probability of a yes that a fitted curve gives to each.
struct FittedAnswers {
  double num_yes = 0.0, num_trials = 0.0;
  double probability = 0.0;
};

/// Probability that answers of the fitted curve lie as far from it as these do, by their
/// deviance. Its mean and variance are those of binomial answers with these probabilities,
/// exactly, since with few answers a level they are not those of chi-squared. Levels of a
/// single answer are taken together in tens, neighbours by the curve; fewer are left out. The
/// mean is less by `num_fitted`, the number of parameters that followed the answers. The
/// distribution is taken as a gamma distribution with these two, which chi-squared is. Absent
/// where fewer than one degree of freedom is left. Not real time.
[[nodiscard]] std::optional<double> misfit_p_value(const std::vector<FittedAnswers>& answers,
                                                   double num_fitted);

}  // namespace jnd::analysis
