#include "core/sound/noise.h"

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/require.h"

namespace jnd::core {
namespace {

/// Highest pole of the pink filter, as a share of the rate. The slope then holds as far up as
/// possible.
constexpr double kHighestPole = 14336.0 / 48000.0;
/// Lowest pole of the pink filter.
constexpr double kLowestPole_hz = 5.0;
constexpr double kLowestHeard_hz = 20.0;

/// Qualities of the two second-order sections of a Butterworth filter of fourth order: 1 / (2
/// cos(pi / 8)) and 1 / (2 cos(3 pi / 8)).
const double kFourthOrder[] = {0.5 / std::cos(std::numbers::pi / 8.0),
                               0.5 / std::cos(3.0 * std::numbers::pi / 8.0)};

/// Returns a filter with a pole and a zero half an octave above it, each placed by the matched
/// z-transform, with gain 1 at 0 Hz.
Biquad half_step_down(double pole_hz, double rate_hz) {
  const auto place = [rate_hz](double frequency_hz) {
    return std::exp(-2.0 * std::numbers::pi * frequency_hz / rate_hz);
  };
  const double pole = place(pole_hz);
  const double zero = place(std::numbers::sqrt2 * pole_hz);
  Biquad filter;
  filter.b0 = (1.0 - pole) / (1.0 - zero);
  filter.b1 = -zero * filter.b0;
  filter.a1 = -pole;
  return filter;
}

/// Returns the filter for the highest pole, whose zero would lie too high.
Biquad last_step_down(double pole_hz, double rate_hz) {
  Biquad filter;
  filter.a1 = -std::exp(-2.0 * std::numbers::pi * pole_hz / rate_hz);
  filter.b0 = 1.0 + filter.a1;
  return filter;
}

/// Returns the root of the sum of squares of the impulse response. The filter must be fresh.
double impulse_norm(NoiseFilter filter, double rate_hz) {
  constexpr double kLongest_s = 2.0;
  double sum = 0.0;
  const auto length = static_cast<std::int64_t>(kLongest_s * rate_hz);
  for (std::int64_t i = 0; i < length; ++i) {
    const double y = filter.next(i == 0 ? 1.0 : 0.0);
    sum += y * y;
  }
  return std::sqrt(sum);
}

}  // namespace

NoiseFilter::NoiseFilter(const NoiseShape& shape, double rate_hz) : rate_hz_(rate_hz) {
  require(rate_hz >= 8000.0 && rate_hz <= 192000.0, "rate_hz", "a rate in [8000, 192000] Hz",
          rate_hz);
  if (shape.kind == NoiseShape::Kind::kPink) {
    double pole_hz = kHighestPole * rate_hz;
    add(last_step_down(pole_hz, rate_hz));
    while (pole_hz > 2.0 * kLowestPole_hz) {
      pole_hz /= 2.0;
      add(half_step_down(pole_hz, rate_hz));
    }
    add(high_pass(kLowestHeard_hz, 1.0 / std::numbers::sqrt2, rate_hz));
  }
  if (shape.kind == NoiseShape::Kind::kBand) {
    require(shape.low_hz < shape.high_hz, "low_hz", "a frequency below high_hz", shape.low_hz);
    for (const double q : kFourthOrder) {
      add(high_pass(shape.low_hz, q, rate_hz));
      add(low_pass(shape.high_hz, q, rate_hz));
    }
  }
  noise_gain_ = impulse_norm(*this, rate_hz);
  require_positive(noise_gain_, "noise_gain");
}

void NoiseFilter::add(const Biquad& section) {
  if (num_sections_ == kMostSections) throw Error("noise: expected fewer sections of a filter");
  sections_[num_sections_++] = section;
}

double NoiseFilter::gain_at(double frequency_hz) const noexcept {
  double gain = 1.0;
  for (std::size_t i = 0; i < num_sections_; ++i) {
    gain *= sections_[i].gain_at(frequency_hz, rate_hz_);
  }
  return gain;
}

Noise::Noise(const NoiseShape& shape, double rate_hz, std::uint64_t seed)
    : filter_(shape, rate_hz),
      stream_(seed, "masking_noise"),
      scale_(std::numbers::sqrt3 / filter_.noise_gain()) {}

}  // namespace jnd::core
