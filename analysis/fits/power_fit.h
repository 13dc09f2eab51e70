#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/statistics/fit_status.h"
#include "core/power_function.h"

namespace jnd::analysis {

/// One magnitude estimate, or the mean of several.
struct Magnitude {
  double intensity = 0.0;  ///< >= 0
  double magnitude = 0.0;  ///< The ratio to the modulus. It is finite.
};

enum class PowerMethod {
  kNonlinear,  ///< "nls": least squares of the magnitudes, over rows with an intensity > 0.
  /// "loglog": a line through the logarithms, over rows with intensity and magnitude > 0.
  kLogLog,
};

[[nodiscard]] constexpr std::string_view to_string(PowerMethod method) noexcept {
  return method == PowerMethod::kNonlinear ? "nls" : "loglog";
}

/// A fitted power law, with the words of the JSON output. Numbers are present only if `status`
/// is kOk.
///
/// The standard errors assume residuals that are independent and have one variance: residuals
/// of the magnitudes (nls) or of their logarithms (loglog). Means of the same participants at
/// every intensity are not independent. To test exponents, compare the exponents of single
/// participants.
struct PowerFit {
  struct Excluded {
    std::size_t row = 0;  ///< The row's index in the data, from 0.
    Magnitude data;
    std::string reason;
  };

  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no value; "" if there is one.
  PowerMethod method = PowerMethod::kNonlinear;
  std::optional<double> k, a;
  /// Standard errors. For nls they come from sse/(n-2) (J^T J)^-1. For loglog they come from
  /// the line, and that of k from the delta method. They are absent at two rows.
  std::optional<double> k_standard_error, a_standard_error;
  /// Intervals by Student's t with n - 2 degrees of freedom. That of k is computed for ln k, so
  /// it stays > 0. They are open below two degrees of freedom, because with one t reaches 12.7
  /// standard errors and the standard error rests on a single number. They are also open if the
  /// law passes through every row, because then no residual shows how far the rows scatter.
  Interval k_ci95, a_ci95;
  /// Why there is no interval although there is a law; "" if there is one.
  std::string no_interval;
  /// The interval is missing because the law passes through every row of more than two.
  bool is_exact = false;
  std::optional<double> r_squared;  ///< 1 - sse / sst; for loglog, of the logarithms.
  std::vector<Excluded> excluded;
  std::vector<std::string> warnings;  ///< Warnings for the reader, one sentence each.
  int num_rows = 0;                   ///< The number of rows that were fitted.
  /// The number of rows at intensity 0, which are left out.
  int num_at_zero = 0;
};

/// Fits Stevens' power law S = k I^a, k > 0. For nls the best k is known for each exponent. The
/// search starts wherever a grid of exponents has a minimum, so it finds the global optimum.
///
/// Rows at intensity 0 are left out and are no degrees of freedom. There the law is 0 for every
/// k and every a > 0 (k for a = 0, infinite for a < 0), so they tell nothing about k and a.
///
/// The status is `degenerate` if no k > 0 and finite a is best: there are fewer than two
/// different intensities > 0, all magnitudes are 0, or only the magnitude at one intensity
/// counts, so that the best exponent is infinite. Throws `core::Error` for an intensity that is
/// not finite and >= 0, or a magnitude that is not finite. Not real time.
[[nodiscard]] PowerFit fit_power(const std::vector<Magnitude>& data,
                                 PowerMethod method = PowerMethod::kNonlinear,
                                 Solver solver = Solver::kCeres);

/// The least-squares power law through two curves at once, both evaluated at `intensities`.
/// Intensities of 0 tell nothing. The thesis (sec. 4) joins estimation and production into one
/// unbiased law in this way.
[[nodiscard]] PowerFit power_between(const core::PowerFunction& first,
                                     const core::PowerFunction& second,
                                     const std::vector<double>& intensities,
                                     Solver solver = Solver::kCeres);

}  // namespace jnd::analysis
