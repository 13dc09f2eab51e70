#include "analysis/fits/normal_tail.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace jnd::analysis {
namespace {

constexpr double kInvSqrtTwoPi = std::numbers::inv_sqrtpi / std::numbers::sqrt2;
constexpr double kHalfLogTwoPi = 0.91893853320467274178;
/// erfc(x / sqrt 2) keeps its full accuracy up to about here, then underflows.
constexpr double kFarTail = 36.0;

/// phi(x) / Phi(-x) for x >= 36: Laplace's continued fraction x + 1/(x + 2/(x + 3/(x + ...)))
/// (Abramowitz and Stegun 26.2.14), eight terms.
double far_mills(double x) noexcept {
  double fraction = x;
  for (int term = 8; term >= 1; --term) fraction = x + term / fraction;
  return fraction;
}

}  // namespace

NormalTails normal_tails(double z) noexcept {
  const double tail = 0.5 * std::erfc(std::fabs(z) / std::numbers::sqrt2);
  NormalTails tails{
      .density = kInvSqrtTwoPi * std::exp(-0.5 * z * z), .lower = tail, .upper = 1.0 - tail};
  if (z > 0.0) std::swap(tails.lower, tails.upper);
  return tails;
}

LogNormalTails log_normal_tails(double z) noexcept {
  const double x = std::fabs(z);
  LogNormalTails tails;  // For z = -x <= 0: the lower tail is the small one.
  if (x < kFarTail) {
    const double tail = 0.5 * std::erfc(x / std::numbers::sqrt2);
    const double density = kInvSqrtTwoPi * std::exp(-0.5 * x * x);
    tails = {tail,           1.0 - tail,
             std::log(tail), std::log1p(-tail),
             density / tail, density / (1.0 - tail)};
  } else {
    const double mills = far_mills(x);
    tails = {0.0, 1.0, -0.5 * x * x - kHalfLogTwoPi - std::log(mills), 0.0, mills, 0.0};
  }
  if (z > 0.0) {
    std::swap(tails.lower, tails.upper);
    std::swap(tails.log_lower, tails.log_upper);
    std::swap(tails.mills_lower, tails.mills_upper);
  }
  return tails;
}

}  // namespace jnd::analysis
