#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/random_stream.h"
#include "core/sound/biquad.h"

namespace jnd::core {

/// What colour a noise has.
struct NoiseShape {
  enum class Kind {
    kWhite,  ///< The same power in every hertz.
    kPink,   ///< The same power in every octave: 3 dB less per octave.
    kBand,   ///< White between two corners, 24 dB less per octave beyond.
  };
  Kind kind = Kind::kWhite;
  double low_hz = 0.0, high_hz = 0.0;  ///< Of a band, 0 < low < high < rate / 2.
};

/// Filters that give noise its colour.
///
/// Pink: poles and zeros of first order that alternate every half octave, so that the slope is
/// -3 dB per octave on average (Corsini and Saletti 1988, IEEE Transactions on Instrumentation
/// and Measurement 37:615). It is within 0.2 dB of a straight line from 100 Hz to a third of
/// the rate. Below 20 Hz, which nobody hears, a Butterworth high pass of second order takes it
/// away. Band: Butterworth filters of fourth order, each of two `Biquad`s.
class NoiseFilter {
 public:
  /// Throws `Error` for a rate outside of 8000 to 192000 Hz and a band that does not fit it.
  /// Not real time.
  NoiseFilter(const NoiseShape& shape, double rate_hz);

  /// Real time.
  [[nodiscard]] double next(double x) noexcept {
    for (std::size_t i = 0; i < num_sections_; ++i) x = sections_[i].next(x);
    return x;
  }
  /// Ratio of amplitudes. Not real time.
  [[nodiscard]] double gain_at(double frequency_hz) const noexcept;
  /// Root mean square of what comes out where white noise of root mean square 1 goes in: the
  /// root of the sum of squares of the impulse response. Not real time.
  [[nodiscard]] double noise_gain() const noexcept { return noise_gain_; }

 private:
  static constexpr std::size_t kMostSections = 20;

  void add(const Biquad& section);

  double rate_hz_;
  std::array<Biquad, kMostSections> sections_{};
  std::size_t num_sections_ = 0;
  double noise_gain_ = 1.0;
};

/// An endless noise of root mean square 1: independent samples, evenly distributed, through a
/// filter. Even samples are white as any independent ones are, and their peaks lie 4.8 dB above
/// their root mean square, while normal ones have none. Each `next` takes the same time.
class Noise {
 public:
  /// Throws as `NoiseFilter`. Not real time.
  Noise(const NoiseShape& shape, double rate_hz, std::uint64_t seed);

  /// Real time.
  [[nodiscard]] double next() noexcept {
    return filter_.next(scale_ * stream_.uniform(-1.0, 1.0));
  }

 private:
  NoiseFilter filter_;
  RandomStream stream_;
  double scale_;
};

}  // namespace jnd::core
