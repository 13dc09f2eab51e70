#pragma once

namespace jnd::analysis {

/// Both tails of the standard normal distribution at one z, and what the likelihood of a probit
/// needs of them. Relative accuracy 1e-13 for every finite z; neither tail is computed as 1 -
/// the other where that would cancel.
struct NormalTails {
  double density;       ///< phi(z)
  double lower, upper;  ///< Phi(z) and Phi(-z); underflow to 0 beyond |z| = 38.
};

[[nodiscard]] NormalTails normal_tails(double z) noexcept;

/// Logarithms of both tails and the inverse Mills ratios phi/Phi, which stay finite where the
/// tails themselves underflow.
struct LogNormalTails {
  double lower, upper;              ///< Phi(z) and Phi(-z)
  double log_lower, log_upper;      ///< ln Phi(z), ln Phi(-z)
  double mills_lower, mills_upper;  ///< phi(z) / Phi(z), phi(z) / Phi(-z)
};

[[nodiscard]] LogNormalTails log_normal_tails(double z) noexcept;

/// The inverse Mills ratios alone, in a third of the time: the slope of a probit's likelihood.
struct MillsRatios {
  double lower, upper;  ///< phi(z) / Phi(z), phi(z) / Phi(-z)
};

[[nodiscard]] MillsRatios mills_ratios(double z) noexcept;

}  // namespace jnd::analysis
