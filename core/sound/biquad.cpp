#include "core/sound/biquad.h"

#include <cmath>
#include <complex>
#include <numbers>

#include "core/require.h"

namespace jnd::core {
namespace {

/// cos w and alpha = sin w / 2q of the cookbook.
struct CookbookAngle {
  double cosine, alpha;
};

CookbookAngle cookbook_angle(double corner_hz, double q, double rate_hz) {
  require_positive(rate_hz, "rate_hz");
  require_positive(q, "q");
  require(corner_hz > 0.0 && corner_hz < rate_hz / 2.0, "corner_hz",
          "a frequency below half of the rate", corner_hz);
  const double angle = 2.0 * std::numbers::pi * corner_hz / rate_hz;
  return {.cosine = std::cos(angle), .alpha = std::sin(angle) / (2.0 * q)};
}

}  // namespace

double Biquad::gain_at(double frequency_hz, double rate_hz) const noexcept {
  const std::complex<double> back =
      std::polar(1.0, -2.0 * std::numbers::pi * frequency_hz / rate_hz);
  return std::abs((b0 + (b1 + b2 * back) * back) / (1.0 + (a1 + a2 * back) * back));
}

Biquad low_pass(double corner_hz, double q, double rate_hz) {
  const auto [cosine, alpha] = cookbook_angle(corner_hz, q, rate_hz);
  const double a0 = 1.0 + alpha;
  Biquad filter;
  filter.b0 = filter.b2 = (1.0 - cosine) / 2.0 / a0;
  filter.b1 = (1.0 - cosine) / a0;
  filter.a1 = -2.0 * cosine / a0;
  filter.a2 = (1.0 - alpha) / a0;
  return filter;
}

Biquad high_pass(double corner_hz, double q, double rate_hz) {
  const auto [cosine, alpha] = cookbook_angle(corner_hz, q, rate_hz);
  const double a0 = 1.0 + alpha;
  Biquad filter;
  filter.b0 = filter.b2 = (1.0 + cosine) / 2.0 / a0;
  filter.b1 = -(1.0 + cosine) / a0;
  filter.a1 = -2.0 * cosine / a0;
  filter.a2 = (1.0 - alpha) / a0;
  return filter;
}

}  // namespace jnd::core
