#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "analysis/statistics/fit_status.h"
#include "core/power_function.h"

namespace jnd::analysis {

/// One judgement, or one mean of several.
struct Magnitude {
  double intensity = 0.0;  ///< >= 0
  double magnitude = 0.0;  ///< Ratio to the modulus, finite.
};

enum class PowerMethod {
  kNonlinear,  ///< "nls": least squares of the magnitudes, rows with intensity > 0.
  kLogLog,     ///< "loglog": a line through the logarithms, rows with both > 0.
};

[[nodiscard]] constexpr std::string_view to_string(PowerMethod method) noexcept {
  return method == PowerMethod::kNonlinear ? "nls" : "loglog";
}

/// A fitted power law, with the words of the JSON output. No number unless `status` is kOk.
///
/// What the standard errors assume: residuals independent and of one variance, of the
/// magnitudes (nls) or of their logarithms (loglog). Means of the same participants at every
/// intensity are not independent; compare participants' own exponents for a test.
struct PowerFit {
  struct Excluded {
    std::size_t row = 0;  ///< Place in the data, from 0.
    Magnitude data;
    std::string reason;
  };

  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no value; "" if there is one.
  PowerMethod method = PowerMethod::kNonlinear;
  std::optional<double> k, a;
  /// nls: from sse/(n-2) (J^T J)^-1; loglog: of the line, for k by the delta method. Absent at
  /// two rows.
  std::optional<double> k_standard_error, a_standard_error;
  /// By Student's t with n - 2 degrees of freedom; for k on ln k, so that it stays > 0. Open
  /// below two degrees of freedom: at one t reaches 12.7 standard errors, of a standard error
  /// that rests on a single number; and where the law passes through every row, so that no
  /// residual tells how far the rows scatter.
  Interval k_ci95, a_ci95;
  /// Why there is no interval though there is a law; "" if there is one.
  std::string no_interval;
  bool is_exact = false;  ///< That is because it passes through every row, more than two.
  std::optional<double> r_squared;  ///< 1 - sse / sst; loglog: of the logarithms.
  std::vector<Excluded> excluded;
  std::vector<std::string> warnings;  ///< What a reader has to know, one sentence each.
  int num_rows = 0;                   ///< Rows that were fitted.
  int num_at_zero = 0;                ///< Rows at intensity 0, which are left out.
};

/// Fits Stevens' power law S = k I^a, k > 0. nls starts wherever a grid of exponents, for each
/// of which the best k is known, has a minimum: what is found is global.
///
/// Rows at intensity 0 are left out: there the law is 0 for every k and every a > 0 (k for
/// a = 0, infinite for a < 0), so they say nothing of either, and are no degrees of freedom.
///
/// `degenerate` where no k > 0 and finite a is best: fewer than two different intensities > 0,
/// magnitudes all 0, or data that only one intensity's magnitude carries, where the best
/// exponent is infinite. Throws `core::Error` for an intensity not finite and >= 0 or a
/// magnitude that is not finite. Not real time.
[[nodiscard]] PowerFit fit_power(const std::vector<Magnitude>& data,
                                 PowerMethod method = PowerMethod::kNonlinear,
                                 Solver solver = Solver::kCeres);

/// The least-squares power law through two curves at once, both evaluated at `intensities`, of
/// which one at 0 tells nothing: how the thesis joins estimation and production (sec. 4) into
/// one unbiased law.
[[nodiscard]] PowerFit power_between(const core::PowerFunction& first,
                                     const core::PowerFunction& second,
                                     const std::vector<double>& intensities,
                                     Solver solver = Solver::kCeres);

}  // namespace jnd::analysis
