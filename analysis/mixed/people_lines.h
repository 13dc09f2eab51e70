#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// One value `y` of one person at `x`.
struct PersonPoint {
  std::size_t person = 0;  ///< From 0, below the number of people.
  double x = 0.0, y = 0.0;
};

struct Line {
  double intercept = 0.0, slope = 0.0;
};

/// The linear mixed model in which everybody has a line of their own:
///
///     y = (b0 + u0) + (b1 + u1) x + e
///
/// (u0, u1) are normal between people with a standard deviation each and a correlation, e is
/// normal with one variance. Estimated by restricted maximum likelihood (Patterson and Thompson
/// 1971) in the form of Laird and Ware (1982); lme4's lmer(y ~ x + (x | person)) is the same.
struct PeopleLines {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< "" where there is a fit.
  Line group;          ///< b0 and b1.
  double intercept_standard_error = 0.0, slope_standard_error = 0.0;
  double intercept_sd = 0.0, slope_sd = 0.0;  ///< Between people; 0 at the bound.
  std::optional<double> correlation;          ///< None where a standard deviation is 0.
  double residual_sd = 0.0;
  double log_likelihood = 0.0;  ///< Restricted.
  std::vector<Line> people;     ///< Their most likely lines given the model (shrunk).
  /// Their least squares' lines; none for somebody with a single x.
  std::vector<std::optional<Line>> own;
};

/// `degenerate` where fewer than three people have two different x, where there are no more
/// than two rows a person, or where every row lies on its person's own line. Throws
/// `core::Error` for a number that is not finite and for a person out of range. Not real time.
[[nodiscard]] PeopleLines fit_people_lines(const std::vector<PersonPoint>& rows,
                                           std::size_t num_people);

enum class LineParameter { kIntercept, kSlope };

/// Where twice the logarithm of the (not restricted) likelihood, every other parameter fitted
/// anew, has fallen by the 95 % quantile of chi-squared with one degree of freedom. Likelihoods
/// of different fixed effects cannot be compared by the restricted one. For rows that have a
/// fit; an end beyond a hundred standard errors is open. Not real time.
[[nodiscard]] Interval people_lines_profile(const std::vector<PersonPoint>& rows,
                                            std::size_t num_people, LineParameter of);

}  // namespace jnd::analysis
