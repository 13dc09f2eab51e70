#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/power_fit.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// A magnitude, and the participant who gave it.
struct PersonMagnitude {
  std::string participant;
  Magnitude data;
};

/// Stevens' power law S = k I^a of a group of people, with the words of the JSON output. It is
/// a linear mixed model of the logarithms,
///
///     ln S = (ln k + u) + (a + v) ln I + e,
///
/// with u and v normal between people and correlated. The fit is by restricted maximum
/// likelihood (`fit_people_lines`). Numbers are present only if `status` is kOk.
struct PeoplePowerFit {
  struct Person {
    std::string participant;
    int num_rows = 0;
    /// The most likely values given the model, which are shrunk to the group's.
    double k = 0.0, a = 0.0;
    /// From the person's rows alone. Absent if all are at a single intensity.
    std::optional<double> own_k, own_a;
  };

  FitStatus status = FitStatus::kNotRun;
  std::string reason;          ///< Why there is no value; "" if there is one.
  std::optional<double> k, a;  ///< The group's law. k is that of the median person.
  std::optional<double> k_standard_error, a_standard_error;
  /// For fewer than `kFewPeople` people the intervals use Student's t with the number of people
  /// minus 1 as degrees of freedom. That is exact if everybody judged the same intensities, and
  /// equals the interval of a mean of own exponents. For more people they use the profile
  /// likelihood. The interval of k is computed for ln k.
  Interval k_ci95, a_ci95;
  std::string interval_method;  ///< "t" or "profile"; "" without a fit.
  std::optional<double> degrees_of_freedom;
  /// Standard deviations between people, and the correlation of ln k and a, which depends on
  /// the unit of I.
  std::optional<double> ln_k_sd, a_sd, correlation;
  /// The standard deviation of rows about their person's law.
  std::optional<double> residual_sd_ln;
  std::optional<double> log_likelihood;  ///< The restricted log-likelihood.
  std::vector<Person> people;            ///< In the order of their first rows.
  std::vector<PowerFit::Excluded> excluded;
  std::vector<std::string> warnings;  ///< Warnings for the reader, one sentence each.
  int num_people = 0, num_rows = 0;   ///< The numbers of people and rows that were fitted.
};

/// From this number of people with two intensities on, the interval uses the profile
/// likelihood. It is then at most 3 % shorter than that of Student's t, and does not need equal
/// designs.
inline constexpr int kFewPeople = 30;

/// Rows with an intensity of 0 or a magnitude <= 0 have no logarithm and are left out. The
/// status is `degenerate` as in `fit_people_lines`. Throws `core::Error` for an intensity that
/// is not finite and >= 0, or a magnitude that is not finite. Not real time.
[[nodiscard]] PeoplePowerFit fit_power_of_people(const std::vector<PersonMagnitude>& data);

}  // namespace jnd::analysis
