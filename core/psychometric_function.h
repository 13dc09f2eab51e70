#pragma once

namespace jnd::core {

/// Probability of the answer "more than the reference" as a function of intensity:
///
///   p(x) = lapse + (1 - 2 lapse) Phi( ln(x / pse) / ln(1 + weber_fraction) )
///
/// With lapse 0 and the pse at the reference, this is the curve of Bergmann Tiest et al. (2013)
/// and of the thesis: 50 % + 50 % erf( ln(x/p) / (sqrt 2 ln(w+1)) ), so that p(pse (1+w)) =
/// 84.13 %.
struct PsychometricFunction {
  /// Point of subjective equality, > 0, in the unit of the intensity.
  double pse = 1.0;
  double weber_fraction = 0.3;  ///< > 0.
  /// Half the share of answers that ignore the stimulus, in [0, 0.5).
  double lapse_rate = 0.0;

  /// `intensity` >= 0. At 0 it returns the limit, `lapse_rate`.
  [[nodiscard]] double probability(double intensity) const noexcept;

  /// Returns the intensity with this `probability`, or NaN outside of (lapse_rate, 1 -
  /// lapse_rate).
  [[nodiscard]] double intensity_at(double probability) const noexcept;
};

/// Cumulative standard normal distribution, accurate in both tails.
[[nodiscard]] double standard_normal_cdf(double z) noexcept;

/// Inverse of `standard_normal_cdf`: -inf at 0, +inf at 1, NaN outside of [0, 1].
[[nodiscard]] double standard_normal_quantile(double probability) noexcept;

}  // namespace jnd::core
