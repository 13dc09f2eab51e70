#include "analysis/fits/sigmoid.h"

#include <cmath>
#include <numbers>

#include "analysis/fits/normal_tail.h"
#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace {

constexpr double kLn2 = std::numbers::ln2;
/// ln ln 2. Below z = -700, where e^z underflows, ln F is z plus this.
constexpr double kLnLn2 = -0.36651292058166432701;
constexpr double kHalfPi = 0.5 * std::numbers::pi;
/// Phi(1)
constexpr double kAtJnd = 0.84134474606854292578;

/// The exponent t for which 2^(-e^z) = e^-t.
double exponent(double z) noexcept { return kLn2 * std::exp(z); }

SigmoidTails gumbel_tails(double z) noexcept {
  const double t = exponent(z), upper = std::exp(-t);
  if (upper == 0.0) return {0.0, 1.0, 0.0, 0.0};
  return {t * upper, -std::expm1(-t), upper, 1.0 - t};
}

LogSigmoidTails log_gumbel_tails(double z) noexcept {
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

/// ln (1 / (1 + e^-z))
double log_logistic(double z) noexcept {
  return z < 0.0 ? z - std::log1p(std::exp(z)) : -std::log1p(std::exp(-z));
}

/// ln F of the hyperbolic secant, with `a` = pi z / 2. `secant_mills` is F' / F.
double log_secant(double a) noexcept {
  return a < -300.0 ? a - std::log(kHalfPi) : std::log(std::atan(std::exp(a)) / kHalfPi);
}
double secant_mills(double a, double density) noexcept {
  return a < -300.0 ? kHalfPi : density / (std::atan(std::exp(a)) / kHalfPi);
}
double secant_density(double a) noexcept { return 0.5 / std::cosh(a); }

}  // namespace

SigmoidTails sigmoid_tails(Sigmoid sigmoid, double z) noexcept {
  switch (sigmoid) {
    case Sigmoid::kNormal: {
      const NormalTails tails = normal_tails(z);
      return {tails.density, tails.lower, tails.upper, -z};
    }
    case Sigmoid::kWeibull:
      return gumbel_tails(z);
    case Sigmoid::kLogistic: {
      const double lower = 1.0 / (1.0 + std::exp(-z)), upper = 1.0 / (1.0 + std::exp(z));
      return {lower * upper, lower, upper, upper - lower};
    }
    case Sigmoid::kReversedGumbel: {
      const SigmoidTails mirrored = gumbel_tails(-z);
      return {mirrored.density, mirrored.upper, mirrored.lower, -mirrored.bend};
    }
    case Sigmoid::kHyperbolicSecant: {
      const double a = kHalfPi * z;
      return {secant_density(a), std::atan(std::exp(a)) / kHalfPi,
              std::atan(std::exp(-a)) / kHalfPi, -kHalfPi * std::tanh(a)};
    }
  }
  return {};
}

LogSigmoidTails log_sigmoid_tails(Sigmoid sigmoid, double z) noexcept {
  switch (sigmoid) {
    case Sigmoid::kNormal: {
      const LogNormalTails tails = log_normal_tails(z);
      return {
          tails.lower,       tails.upper, tails.log_lower, tails.log_upper, tails.mills_lower,
          tails.mills_upper, -z};
    }
    case Sigmoid::kWeibull:
      return log_gumbel_tails(z);
    case Sigmoid::kLogistic: {
      const SigmoidTails tails = sigmoid_tails(sigmoid, z);
      return {tails.lower, tails.upper, log_logistic(z), log_logistic(-z),
              tails.upper, tails.lower, tails.bend};
    }
    case Sigmoid::kReversedGumbel: {
      const LogSigmoidTails mirrored = log_gumbel_tails(-z);
      return {mirrored.upper,     mirrored.lower,       mirrored.log_upper,
              mirrored.log_lower, mirrored.mills_upper, mirrored.mills_lower,
              -mirrored.bend};
    }
    case Sigmoid::kHyperbolicSecant: {
      const double a = kHalfPi * z;
      const SigmoidTails tails = sigmoid_tails(sigmoid, z);
      return {tails.lower,
              tails.upper,
              log_secant(a),
              log_secant(-a),
              secant_mills(a, tails.density),
              secant_mills(-a, tails.density),
              tails.bend};
    }
  }
  return {};
}

double sigmoid_quantile(Sigmoid sigmoid, double probability) noexcept {
  switch (sigmoid) {
    case Sigmoid::kNormal:
      return core::standard_normal_quantile(probability);
    case Sigmoid::kWeibull:
      return std::log(-std::log1p(-probability) / kLn2);
    case Sigmoid::kLogistic:
      return std::log(probability) - std::log1p(-probability);
    case Sigmoid::kReversedGumbel:
      return -std::log(-std::log(probability) / kLn2);
    case Sigmoid::kHyperbolicSecant:
      return std::log(std::tan(kHalfPi * probability)) / kHalfPi;
  }
  return 0.0;
}

double sigmoid_jnd(Sigmoid sigmoid) noexcept {
  if (sigmoid == Sigmoid::kNormal) return 1.0;
  // ln(-ln(1 - Phi(1)) / ln 2)
  if (sigmoid == Sigmoid::kWeibull) return 0.976833579965697;
  return sigmoid_quantile(sigmoid, kAtJnd);
}

double sigmoid_reach(Sigmoid sigmoid) noexcept {
  if (sigmoid == Sigmoid::kNormal) return 8.0;
  return sigmoid == Sigmoid::kHyperbolicSecant ? 24.0 : 37.0;
}

}  // namespace jnd::analysis
