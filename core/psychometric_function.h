#pragma once

namespace jnd::core {

/// Probability of "more than the reference" as a function of intensity:
///
///     p(x) = lapse + (1 - 2 lapse) Phi( ln(x / pse) / ln(1 + weber_fraction) )
///
/// With lapse 0 and the pse at the reference this is the curve of Bergmann Tiest et al. (2013)
/// and of the thesis: 50 % + 50 % erf( ln(x/p) / (sqrt 2 ln(w+1)) ), so that p(pse (1+w))
/// = 84.13 %.
struct PsychometricFunction {
  double pse = 1.0;             ///< Point of subjective equality, > 0, unit of the intensity.
  double weber_fraction = 0.3;  ///< > 0.
  double lapse_rate = 0.0;      ///< [0, 0.5): answers given without regard to the stimulus.

  /// `intensity` >= 0; at 0 the limit, `lapse_rate`.
  [[nodiscard]] double probability(double intensity) const noexcept;

  /// The intensity at which `probability` holds; NaN outside (lapse_rate, 1 - lapse_rate).
  [[nodiscard]] double intensity_at(double probability) const noexcept;
};

/// Cumulative standard normal distribution, accurate in both tails.
[[nodiscard]] double standard_normal_cdf(double z) noexcept;

/// Its inverse; -inf at 0, +inf at 1, NaN outside [0, 1].
[[nodiscard]] double standard_normal_quantile(double probability) noexcept;

}  // namespace jnd::core
