#include "analysis/mixed/mixed_link.h"

#include <array>
#include <cmath>
#include <utility>

#include "analysis/fits/sigmoid.h"

namespace jnd::analysis {
namespace {

/// The sigmoid of a link, and the number that is subtracted from eta first. Weibull's sigmoid
/// is 1 - 2^(-e^z), so z = eta - ln ln 2.
std::pair<Sigmoid, double> sigmoid_of(MixedLink link) noexcept {
  constexpr double kLnLn2 = -0.36651292058166432701;
  if (link == MixedLink::kProbit) return {Sigmoid::kNormal, 0.0};
  if (link == MixedLink::kLogit) return {Sigmoid::kLogistic, 0.0};
  return {Sigmoid::kWeibull, kLnLn2};
}

constexpr std::array<std::pair<MixedLink, std::string_view>, 3> kLinkNames = {
    {{MixedLink::kProbit, "probit"},
     {MixedLink::kLogit, "logit"},
     {MixedLink::kCloglog, "cloglog"}}};

}  // namespace

std::string_view to_string(MixedLink link) noexcept {
  for (const auto& [one, name] : kLinkNames) {
    if (one == link) return name;
  }
  return "";
}

std::optional<MixedLink> mixed_link(std::string_view name) noexcept {
  for (const auto& [one, its_name] : kLinkNames) {
    if (its_name == name) return one;
  }
  return std::nullopt;
}

MixedCurvePoint curve_point(const MixedCurve& curve, double eta) noexcept {
  const auto [sigmoid, offset] = sigmoid_of(curve.link);
  const LogSigmoidTails tails = log_sigmoid_tails(sigmoid, eta - offset);
  if (curve.guess_rate == 0.0 && curve.lapse_rate == 0.0) {
    return {tails.log_lower, tails.log_upper, tails.mills_lower, tails.mills_upper, tails.bend};
  }
  const double span = 1.0 - curve.guess_rate - curve.lapse_rate;
  const double yes = curve.guess_rate + span * tails.lower;
  const double no = curve.lapse_rate + span * tails.upper;
  const bool is_low = tails.lower < tails.upper;
  const double density =
      is_low ? tails.mills_lower * tails.lower : tails.mills_upper * tails.upper;
  // Without guesses P'/P equals that of F, which stays finite where both underflow. The same
  // holds for P'/(1-P) without lapses.
  const bool no_guesses = curve.guess_rate == 0.0, no_lapses = curve.lapse_rate == 0.0;
  return {no_guesses ? std::log(span) + tails.log_lower : std::log(yes),
          no_lapses ? std::log(span) + tails.log_upper : std::log(no),
          no_guesses ? tails.mills_lower : span * density / yes,
          no_lapses ? tails.mills_upper : span * density / no, tails.bend};
}

double curve_probability(const MixedCurve& curve, double eta) noexcept {
  const auto [sigmoid, offset] = sigmoid_of(curve.link);
  return curve.guess_rate + (1.0 - curve.guess_rate - curve.lapse_rate) *
                                sigmoid_tails(sigmoid, eta - offset).lower;
}

double link_quantile(MixedLink link, double probability) noexcept {
  const auto [sigmoid, offset] = sigmoid_of(link);
  return sigmoid_quantile(sigmoid, probability) + offset;
}

}  // namespace jnd::analysis
