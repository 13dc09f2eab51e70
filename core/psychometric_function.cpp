#include "core/psychometric_function.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace jnd::core {

double PsychometricFunction::probability(double intensity) const noexcept {
  const double z = std::log(intensity / pse) / std::log1p(weber_fraction);
  return lapse_rate + (1.0 - 2.0 * lapse_rate) * standard_normal_cdf(z);
}

double PsychometricFunction::intensity_at(double probability) const noexcept {
  const double without_lapse = (probability - lapse_rate) / (1.0 - 2.0 * lapse_rate);
  if (!(without_lapse > 0.0 && without_lapse < 1.0)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return pse * std::exp(standard_normal_quantile(without_lapse) * std::log1p(weber_fraction));
}

double standard_normal_cdf(double z) noexcept {
  return 0.5 * std::erfc(-z / std::numbers::sqrt2);
}

double standard_normal_quantile(double probability) noexcept {
  if (!(probability >= 0.0 && probability <= 1.0)) {
    return std::numeric_limits<double>::quiet_NaN();
  }
  if (probability == 0.0) return -std::numeric_limits<double>::infinity();
  if (probability == 1.0) return std::numeric_limits<double>::infinity();
  // The computation uses the lower tail, where the cdf keeps its relative accuracy.
  const double tail = probability < 0.5 ? probability : 1.0 - probability;
  // It starts from Hastings' rational approximation (Abramowitz and Stegun 26.2.23), whose
  // error is below 4.5e-4.
  const double t = std::sqrt(-2.0 * std::log(tail));
  double z = -(t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                       (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308))));
  // Halley's steps converge cubically.
  for (int step = 0; step < 3; ++step) {
    const double density =
        std::exp(-0.5 * z * z) * std::numbers::inv_sqrtpi / std::numbers::sqrt2;
    const double newton = (standard_normal_cdf(z) - tail) / density;
    z -= newton / (1.0 + 0.5 * z * newton);
  }
  return probability < 0.5 ? z : -z;
}

}  // namespace jnd::core
