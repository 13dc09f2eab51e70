#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/random_stream.h"
#include "core/sound/biquad.h"

namespace jnd::core {

/// The colour of a noise.
struct NoiseShape {
  enum class Kind {
    kWhite,  ///< Equal power in every hertz.
    kPink,   ///< Equal power in every octave: 3 dB less per octave.
    kBand,   ///< White between two corners, 24 dB less per octave beyond them.
  };
  Kind kind = Kind::kWhite;
  double low_hz = 0.0, high_hz = 0.0;  ///< For a band: 0 < low < high < rate / 2.
};

/// Filters that give noise its colour.
///
///   Pink: poles and zeros of first order alternate every half octave, so that the slope is -3
///         dB per octave on average (Corsini and Saletti 1988, IEEE Transactions on
///         Instrumentation and Measurement 37:615). It is within 0.2 dB of a straight line from
///         100 Hz to a third of the rate. A Butterworth high pass of second order removes what
///         is below 20 Hz, which nobody hears.
///   Band: Butterworth filters of fourth order, each made of two `Biquad`s.
class NoiseFilter {
 public:
  /// Throws `Error` for a rate outside of 8000 to 192000 Hz and for a band that does not fit
  /// it. Not real time.
  NoiseFilter(const NoiseShape& shape, double rate_hz);

  /// Real time.
  [[nodiscard]] double next(double x) noexcept {
    for (std::size_t i = 0; i < num_sections_; ++i) x = sections_[i].next(x);
    return x;
  }
  /// Returns a ratio of amplitudes. Not real time.
  [[nodiscard]] double gain_at(double frequency_hz) const noexcept;
  /// Returns the root mean square of the output for white noise of root mean square 1: the root
  /// of the sum of squares of the impulse response. Not real time.
  [[nodiscard]] double noise_gain() const noexcept { return noise_gain_; }

 private:
  static constexpr std::size_t kMostSections = 20;

  void add(const Biquad& section);

  double rate_hz_;
  std::array<Biquad, kMostSections> sections_{};
  std::size_t num_sections_ = 0;
  double noise_gain_ = 1.0;
};

/// An endless noise of root mean square 1, made from independent, uniformly distributed samples
/// and a filter. Uniform samples are as white as any independent ones, and their peaks lie 4.8
/// dB above their root mean square, while normal ones have no largest peak. Each call of `next`
/// takes the same time.
class Noise {
 public:
  /// Throws like `NoiseFilter`. Not real time.
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
