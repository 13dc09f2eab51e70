#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/power_fit.h"
#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// A magnitude and whose it is.
struct PersonMagnitude {
  std::string participant;
  Magnitude data;
};

/// Stevens' power law S = k I^a of a group of people, with the words of the JSON output: a
/// linear mixed model of the logarithms,
///
///     ln S = (ln k + u) + (a + v) ln I + e,
///
/// u and v normal between people and correlated, by restricted maximum likelihood
/// (`fit_people_lines`). No number unless `status` is kOk.
struct PeoplePowerFit {
  struct Person {
    std::string participant;
    int num_rows = 0;
    double k = 0.0, a = 0.0;             ///< Most likely given the model: shrunk to the group.
    std::optional<double> own_k, own_a;  ///< Of their rows alone; none at a single intensity.
  };

  FitStatus status = FitStatus::kNotRun;
  std::string reason;          ///< Why there is no value; "" if there is one.
  std::optional<double> k, a;  ///< Of the group: k is that of the median person.
  std::optional<double> k_standard_error, a_standard_error;
  /// Below `kFewPeople` people by Student's t with as many degrees of freedom as people less 1,
  /// which is exact where everybody judged the same intensities and the interval of a mean of
  /// own exponents; else by the profile of the likelihood. For k on ln k.
  Interval k_ci95, a_ci95;
  std::string interval_method;  ///< "t" or "profile"; "" without a fit.
  std::optional<double> degrees_of_freedom;
  /// Between people. The correlation is that of ln k and a, which depends on the unit of I.
  std::optional<double> ln_k_sd, a_sd, correlation;
  std::optional<double> residual_sd_ln;  ///< Of rows about their person's law.
  std::optional<double> log_likelihood;  ///< Restricted.
  std::vector<Person> people;            ///< In the order of their first rows.
  std::vector<PowerFit::Excluded> excluded;
  std::vector<std::string> warnings;  ///< What a reader has to know, one sentence each.
  int num_people = 0, num_rows = 0;   ///< That were fitted.
};

/// People at two intensities from which on the interval is by the profile of the likelihood.
/// There it is at most 3 % shorter than Student's t, and needs no equal designs.
inline constexpr int kFewPeople = 30;

/// Rows whose intensity or magnitude is 0 or whose magnitude is negative have no logarithm and
/// are left out. `degenerate` as `fit_people_lines`. Throws `core::Error` for an intensity not
/// finite and >= 0 or a magnitude that is not finite. Not real time.
[[nodiscard]] PeoplePowerFit fit_power_of_people(const std::vector<PersonMagnitude>& data);

}  // namespace jnd::analysis
