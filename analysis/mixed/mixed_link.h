#pragma once

#include <optional>
#include <string_view>

namespace jnd::analysis {

/// The curve F between the linear predictor eta and the answer.
enum class MixedLink {
  kProbit,   ///< F(eta) = Phi(eta)
  kLogit,    ///< F(eta) = 1 / (1 + exp(-eta))
  kCloglog,  ///< F(eta) = 1 - exp(-exp(eta))
};

/// "probit", "logit" or "cloglog".
[[nodiscard]] std::string_view to_string(MixedLink link) noexcept;
/// The link with this name. It is absent for any other word.
[[nodiscard]] std::optional<MixedLink> mixed_link(std::string_view name) noexcept;

/// The curve P(yes) = guess + (1 - guess - lapse) F(eta).
struct MixedCurve {
  MixedLink link = MixedLink::kProbit;
  double guess_rate = 0.0;  ///< In [0, 1).
  double lapse_rate = 0.0;  ///< At least 0. The sum with the guess rate is below 1.
};

/// P and its derivatives at one eta, as the likelihood of counts needs them. If guess and lapse
/// rate are 0, all values stay finite in both tails.
struct MixedCurvePoint {
  double log_yes, log_no;    ///< ln P, ln (1 - P)
  double rise_yes, rise_no;  ///< P' / P, P' / (1 - P)
  double bend;               ///< P'' / P'
};

[[nodiscard]] MixedCurvePoint curve_point(const MixedCurve& curve, double eta) noexcept;

/// P(yes) itself.
[[nodiscard]] double curve_probability(const MixedCurve& curve, double eta) noexcept;

/// The eta at which F has this value, which is in (0, 1).
[[nodiscard]] double link_quantile(MixedLink link, double probability) noexcept;

}  // namespace jnd::analysis
