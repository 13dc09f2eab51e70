#include "analysis/fits/log_product.h"

#include <cmath>

#include "analysis/statistics/distributions.h"

namespace jnd::analysis {
namespace {

/// Whether to multiply the factors. With a smaller step the gamma functions would cancel.
bool is_by_factors(double step, double count) noexcept {
  constexpr double kMostFactors = 2000.0;
  return count <= kMostFactors || !(step > 1e-7);
}

}  // namespace

LogProduct log_product(double first, double step, double count) {
  LogProduct product;
  if (is_by_factors(step, count)) {
    for (double factor = 0.0; factor < count; factor += 1.0) {
      const double value = first + factor * step;
      const double inverse = 1.0 / value;
      product.value += std::log(value);
      product.by_first += inverse;
      product.by_step += factor / value;
      product.squares += inverse * inverse;
    }
    return product;
  }
  // step^count Gamma(first / step + count) / Gamma(first / step)
  const double ratio = first / step;
  const double by_ratio = digamma(ratio + count) - digamma(ratio);
  product.value = count * std::log(step) + std::lgamma(ratio + count) - std::lgamma(ratio);
  product.by_first = by_ratio / step;
  product.by_step = (count - ratio * by_ratio) / step;
  product.squares = (trigamma(ratio) - trigamma(ratio + count)) / (step * step);
  return product;
}

double log_product_value(double first, double step, double count) {
  if (!is_by_factors(step, count)) {
    const double ratio = first / step;
    return count * std::log(step) + std::lgamma(ratio + count) - std::lgamma(ratio);
  }
  double value = 0.0;
  for (double factor = 0.0; factor < count; factor += 1.0) {
    value += std::log(first + factor * step);
  }
  return value;
}

}  // namespace jnd::analysis
