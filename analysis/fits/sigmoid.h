#pragma once

namespace jnd::analysis {

/// The shapes of a psychometric function. F(z) rises from 0 to 1, and F(0) = 0.5.
enum class Sigmoid {
  kNormal,  ///< Phi(z)
  /// 1 - 2^(-e^z). With z = shape ln(x / median) it is Weibull's distribution of x. Over x
  /// itself it is Gumbel's distribution of the smallest of many.
  kWeibull,
  kLogistic,          ///< 1 / (1 + e^-z)
  kReversedGumbel,    ///< 2^(-e^-z): Gumbel's distribution of the largest of many.
  kHyperbolicSecant,  ///< 2 / pi arctan(e^(pi z / 2))
};

/// Both tails at one z. Neither is computed as 1 minus the other where that would cancel.
struct SigmoidTails {
  double density;       ///< F'(z)
  double lower, upper;  ///< F(z), 1 - F(z)
  double bend;          ///< F''(z) / F'(z)
};

[[nodiscard]] SigmoidTails sigmoid_tails(Sigmoid sigmoid, double z) noexcept;

/// Tails with their logarithms and ratios, which stay finite where the tails underflow.
struct LogSigmoidTails {
  double lower, upper;
  double log_lower, log_upper;      ///< ln F(z), ln (1 - F(z))
  double mills_lower, mills_upper;  ///< F' / F, F' / (1 - F)
  double bend;
};

[[nodiscard]] LogSigmoidTails log_sigmoid_tails(Sigmoid sigmoid, double z) noexcept;

/// The z at which F(z) = `probability`, which is in (0, 1).
[[nodiscard]] double sigmoid_quantile(Sigmoid sigmoid, double probability) noexcept;

/// The z at which F(z) = Phi(1) = 84.13 %, one just noticeable difference above the median.
[[nodiscard]] double sigmoid_jnd(Sigmoid sigmoid) noexcept;

/// Beyond this |z| the tails are lost in rounding beside 1.
[[nodiscard]] double sigmoid_reach(Sigmoid sigmoid) noexcept;

}  // namespace jnd::analysis
