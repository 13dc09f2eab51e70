#pragma once

namespace jnd::analysis {

/// Both tails of the standard normal distribution at one z, as the likelihood of a probit needs
/// them. The relative accuracy is 1e-13 for every finite z. Neither tail is computed as 1 minus
/// the other where that would cancel.
struct NormalTails {
  double density;       ///< phi(z)
  double lower, upper;  ///< Phi(z) and Phi(-z). They underflow to 0 beyond |z| = 38.
};

[[nodiscard]] NormalTails normal_tails(double z) noexcept;

/// The logarithms of both tails and the inverse Mills ratios phi/Phi. They stay finite where
/// the tails underflow.
struct LogNormalTails {
  double lower, upper;              ///< Phi(z) and Phi(-z)
  double log_lower, log_upper;      ///< ln Phi(z), ln Phi(-z)
  double mills_lower, mills_upper;  ///< phi(z) / Phi(z), phi(z) / Phi(-z)
};

[[nodiscard]] LogNormalTails log_normal_tails(double z) noexcept;

/// Only the inverse Mills ratios, which give the slope of a probit's log-likelihood. They take
/// a third of the time.
struct MillsRatios {
  double lower, upper;  ///< phi(z) / Phi(z), phi(z) / Phi(-z)
};

[[nodiscard]] MillsRatios mills_ratios(double z) noexcept;

}  // namespace jnd::analysis
