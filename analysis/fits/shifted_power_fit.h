#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/fits/power_fit.h"

namespace jnd::analysis {

/// What a power law has besides its factor and exponent.
enum class PowerShift {
  kNone,       ///< S = k I^a
  kThreshold,  ///< S = k (I - I0)^a: nothing is felt below I0 (Ekman 1956); I0 may be < 0.
  kOffset,     ///< S = S0 + k I^a: what is felt without a stimulus. Least squares of S alone.
};

[[nodiscard]] constexpr std::string_view to_string(PowerShift shift) noexcept {
  return shift == PowerShift::kNone        ? "none"
         : shift == PowerShift::kThreshold ? "threshold"
                                           : "offset";
}

/// A power law whose intervals are by the profile of its sum of squares: all values of a
/// parameter for which, the others being fitted anew, the squares grow by no more than F with 1
/// and n - p degrees of freedom allows. Like those of `PowerFit` they assume residuals that are
/// independent and of one variance, but not that the squares are a parabola.
struct ShiftedPowerFit {
  FitStatus status = FitStatus::kNotRun;
  std::string reason;  ///< Why there is no value; "" if there is one.
  PowerMethod method = PowerMethod::kNonlinear;
  PowerShift shift = PowerShift::kNone;
  std::optional<double> k, a;
  std::optional<double> intensity_threshold;  ///< I0, in the unit of the intensities.
  std::optional<double> magnitude_offset;     ///< S0
  Interval k_ci95, a_ci95, shift_ci95;        ///< An end that the data leave open is absent.
  std::string no_interval;                    ///< Why there is none; "" if there is one.
  std::optional<double> sum_of_squares, r_squared;
  /// With a shift: F with 1 and n - 3 degrees of freedom against the law without it.
  std::optional<double> shift_statistic, shift_p_value;
  int num_rows = 0, num_left_out = 0;
};

/// The least-squares law over exponents of -4 to 8 and thresholds from just below the smallest
/// intensity > 0 down to three times the largest below 0. Rows without an intensity > 0 are
/// left out, with kLogLog those without a magnitude > 0 as well. `degenerate` where fewer rows
/// than parameters are left, they have too few intensities, or the best law lies at an end of
/// the range. Throws `core::Error` for an intensity not finite and >= 0, a magnitude that is
/// not finite, or an offset with kLogLog. Not real time.
[[nodiscard]] ShiftedPowerFit fit_shifted_power(const std::vector<Magnitude>& data,
                                                PowerMethod method, PowerShift shift);

}  // namespace jnd::analysis
