#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// One value `y` of one person at `x`.
struct PersonPoint {
  std::size_t person = 0;  ///< The person's index, from 0 to below the number of people.
  double x = 0.0, y = 0.0;
};

struct Line {
  double intercept = 0.0, slope = 0.0;
};

/// A linear mixed model that gives each person a line:
///
///     y = (b0 + u0) + (b1 + u1) x + e
///
/// (u0, u1) is normal between people, with two standard deviations and a correlation. e is
/// normal with one variance. The model is fitted by restricted maximum likelihood (Patterson
/// and Thompson 1971) in the form of Laird and Ware (1982). lme4's lmer(y ~ x + (x | person))
/// is the same model.
struct PeopleLines {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no fit; "" if there is one.
  Line group;          ///< b0 and b1.
  double intercept_standard_error = 0.0, slope_standard_error = 0.0;
  /// Standard deviations between people; 0 if they are at their bound.
  double intercept_sd = 0.0, slope_sd = 0.0;
  std::optional<double> correlation;  ///< Absent if a standard deviation is 0.
  double residual_sd = 0.0;
  double log_likelihood = 0.0;  ///< The restricted log-likelihood.
  /// People's most likely lines given the model, which are shrunk to the group's line.
  std::vector<Line> people;
  /// People's own least-squares lines. Absent for a person with a single x.
  std::vector<std::optional<Line>> own;
};

/// The status is `degenerate` if fewer than three people have two different x, if there are no
/// more than two rows per person, or if every row lies on its person's own line. Throws
/// `core::Error` for a number that is not finite and for a person out of range. Not real time.
[[nodiscard]] PeopleLines fit_people_lines(const std::vector<PersonPoint>& rows,
                                           std::size_t num_people);

enum class LineParameter { kIntercept, kSlope };

/// The profile-likelihood interval of a parameter. Its ends lie where twice the log-likelihood,
/// with every other parameter refitted, has fallen by the 95 % quantile of chi-squared with one
/// degree of freedom. It uses the full likelihood, because restricted likelihoods of different
/// fixed effects cannot be compared. The rows must have a fit. An end beyond a hundred standard
/// errors is open. Not real time.
[[nodiscard]] Interval people_lines_profile(const std::vector<PersonPoint>& rows,
                                            std::size_t num_people, LineParameter of);

}  // namespace jnd::analysis
