#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/fits/power_fit.h"

namespace jnd::analysis {

/// The third parameter of a power law, beside its factor and exponent.
enum class PowerShift {
  kNone,       ///< S = k I^a
  kThreshold,  ///< S = k (I - I0)^a: nothing is felt below I0 (Ekman 1956). I0 may be < 0.
  kOffset,     ///< S = S0 + k I^a: S0 is felt without a stimulus. Least squares of S only.
};

[[nodiscard]] constexpr std::string_view to_string(PowerShift shift) noexcept {
  return shift == PowerShift::kNone        ? "none"
         : shift == PowerShift::kThreshold ? "threshold"
                                           : "offset";
}

/// A power law whose intervals come from the profile of its sum of squares. An interval holds
/// all values of a parameter for which the squares, with the other parameters refitted, grow by
/// no more than F with 1 and n - p degrees of freedom allows. Like the intervals of `PowerFit`
/// they assume independent residuals of one variance, but not that the sum of squares is a
/// parabola.
struct ShiftedPowerFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no value; "" if there is one.
  PowerMethod method = PowerMethod::kNonlinear;
  PowerShift shift = PowerShift::kNone;
  std::optional<double> k, a;
  /// The threshold I0 in the unit of the intensities.
  std::optional<double> intensity_threshold;
  std::optional<double> magnitude_offset;  ///< The offset S0.
  Interval k_ci95, a_ci95, shift_ci95;     ///< An end that the data leave open is absent.
  std::string no_interval;                 ///< Why there is no interval; "" if there is one.
  std::optional<double> sum_of_squares, r_squared;
  /// The test of the shift: F with 1 and n - 3 degrees of freedom against the law without it.
  std::optional<double> shift_statistic, shift_p_value;
  int num_rows = 0, num_left_out = 0;
};

/// Finds the least-squares law over exponents from -4 to 8. Thresholds range from just below
/// the smallest intensity > 0 down to minus three times the largest intensity. Rows without an
/// intensity > 0 are left out; with kLogLog, rows without a magnitude > 0 are left out too. The
/// status is `degenerate` if fewer rows than parameters are left, if they have too few
/// intensities, or if the best law lies at an end of the range. Throws `core::Error` for an
/// intensity that is not finite and >= 0, a magnitude that is not finite, or an offset with
/// kLogLog. Not real time.
[[nodiscard]] ShiftedPowerFit fit_shifted_power(const std::vector<Magnitude>& data,
                                                PowerMethod method, PowerShift shift);

}  // namespace jnd::analysis
