#include "analysis/fits/sigmoid.h"

#include <cmath>
#include <numbers>

#include "analysis/fits/normal_tail.h"
#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace {

constexpr double kLn2 = std::numbers::ln2;
/// ln ln 2: below z = -700, where e^z underflows, ln F is z plus this.
constexpr double kLnLn2 = -0.36651292058166432701;

/// 2^(-e^z) = e^-t.
double exponent(double z) noexcept { return kLn2 * std::exp(z); }

}  // namespace

SigmoidTails sigmoid_tails(Sigmoid sigmoid, double z) noexcept {
  if (sigmoid == Sigmoid::kNormal) {
    const NormalTails tails = normal_tails(z);
    return {tails.density, tails.lower, tails.upper, -z};
  }
  const double t = exponent(z), upper = std::exp(-t);
  if (upper == 0.0) return {0.0, 1.0, 0.0, 0.0};
  return {t * upper, -std::expm1(-t), upper, 1.0 - t};
}

LogSigmoidTails log_sigmoid_tails(Sigmoid sigmoid, double z) noexcept {
  if (sigmoid == Sigmoid::kNormal) {
    const LogNormalTails tails = log_normal_tails(z);
    return {tails.lower,       tails.upper, tails.log_lower, tails.log_upper, tails.mills_lower,
            tails.mills_upper, -z};
  }
  const double t = exponent(z), upper = std::exp(-t), lower = -std::expm1(-t);
  return {.lower = lower,
          .upper = upper,
          .log_lower = lower > 1e-290 ? std::log(lower) : z + kLnLn2,
          .log_upper = -t,
          .mills_lower = t < 1e-8    ? 1.0 - 0.5 * t
                         : t > 700.0 ? 0.0
                                     : t / std::expm1(t),
          .mills_upper = t,
          .bend = 1.0 - t};
}

double sigmoid_quantile(Sigmoid sigmoid, double probability) noexcept {
  if (sigmoid == Sigmoid::kNormal) return core::standard_normal_quantile(probability);
  return std::log(-std::log1p(-probability) / kLn2);
}

double sigmoid_jnd(Sigmoid sigmoid) noexcept {
  // ln(-ln(1 - Phi(1)) / ln 2)
  return sigmoid == Sigmoid::kNormal ? 1.0 : 0.976833579965697;
}

double sigmoid_reach(Sigmoid sigmoid) noexcept {
  return sigmoid == Sigmoid::kNormal ? 8.0 : 37.0;
}

}  // namespace jnd::analysis
