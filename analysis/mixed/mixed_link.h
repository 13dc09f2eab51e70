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

/// "probit", "logit", "cloglog".
[[nodiscard]] std::string_view to_string(MixedLink link) noexcept;
/// The link of this name; none for another word.
[[nodiscard]] std::optional<MixedLink> mixed_link(std::string_view name) noexcept;

/// P(yes) = guess + (1 - guess - lapse) F(eta).
struct MixedCurve {
  MixedLink link = MixedLink::kProbit;
  double guess_rate = 0.0;  ///< 0 to below 1.
  double lapse_rate = 0.0;  ///< With the guess rate below 1.
};

/// P and its derivatives at one eta, as the likelihood of counts needs them. Everything stays
/// finite in both tails where guess and lapse rate are 0.
struct MixedCurvePoint {
  double log_yes, log_no;    ///< ln P, ln (1 - P)
  double rise_yes, rise_no;  ///< P' / P, P' / (1 - P)
  double bend;               ///< P'' / P'
};

[[nodiscard]] MixedCurvePoint curve_point(const MixedCurve& curve, double eta) noexcept;

/// P(yes) itself.
[[nodiscard]] double curve_probability(const MixedCurve& curve, double eta) noexcept;

/// eta where F has this value, which is in (0, 1).
[[nodiscard]] double link_quantile(MixedLink link, double probability) noexcept;

}  // namespace jnd::analysis
