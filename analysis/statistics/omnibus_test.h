#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/statistics/fit_status.h"

namespace jnd::analysis {

/// The value of each person under each condition: `values[person][condition]`, all finite.
struct RepeatedMeasures {
  std::vector<std::string> people, conditions;
  std::vector<std::vector<double>> values;
};

/// A p value after both degrees of freedom were multiplied by `epsilon`.
struct SphericityCorrection {
  /// From 1 / (number of conditions - 1) to 1. It is 1 if sphericity holds.
  double epsilon = 1.0;
  double p_value = 1.0;
};

/// Mauchly's test (1940) of whether the differences between conditions all vary alike.
struct SphericityTest {
  double w = 1.0;            ///< It is 1 if they do, and approaches 0 as they differ.
  double chi_squared = 0.0;  ///< Box's approximation (1949) of the distribution of ln W.
  double degrees_of_freedom = 0.0;
  double p_value = 1.0;  ///< With the term of second order (Anderson 2003, section 10.7).
};

/// Whether any of several conditions differs from any other.
struct OmnibusTest {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why a value is undefined; "" if all are defined.
  std::string method;  ///< The test in words.
  int num_people = 0, num_conditions = 0;
  std::string statistic_name;  ///< "F" or "chi_squared".
  std::optional<double> statistic;
  /// The degrees of freedom of the conditions.
  std::optional<double> degrees_of_freedom;
  std::optional<double> error_degrees_of_freedom;  ///< Only F has them.
  std::optional<double> p_value;                   ///< The p value without a correction.
  std::optional<SphericityCorrection> greenhouse_geisser,
      huynh_feldt;  ///< Analysis of variance.
  /// Analysis of variance of three or more conditions. It is absent if there are no more people
  /// than contrasts, because W is then 0 whatever the conditions do.
  std::optional<SphericityTest> mauchly;
  /// Analysis of variance: of the variation within people, and of all of it (Olejnik and Algina
  /// 2003), the part that goes with the conditions.
  std::optional<double> partial_eta_squared, generalized_eta_squared;
  /// Only for Friedman's test: Kendall's coefficient of concordance W, 0 to 1.
  std::optional<double> concordance;
};

/// Analysis of variance of one factor within people. F is the mean square between conditions
/// divided by that of people by conditions. If the differences between conditions do not all
/// have the same variance (no sphericity), the degrees of freedom need a correction, by
/// Greenhouse and Geisser (1959) or, less strictly, by Huynh and Feldt (1976). The status is
/// degenerate with fewer than two people or conditions, or if all people change alike. Throws
/// `core::Error` if rows have different lengths or a value is not finite. Not real time.
[[nodiscard]] OmnibusTest repeated_measures_anova(const RepeatedMeasures& data);

/// Friedman's test (1937) of the ranks within each person. Ties are midranks, and the variance
/// is corrected for them. p comes from chi-squared. Status and errors are as for
/// `repeated_measures_anova`.
[[nodiscard]] OmnibusTest friedman_test(const RepeatedMeasures& data);

}  // namespace jnd::analysis
