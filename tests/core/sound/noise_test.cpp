#include "core/sound/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/error.h"
#include "core/sound/sound_level.h"

namespace jnd::core {
namespace noise_test {

using Kind = NoiseShape::Kind;

constexpr double kRate_hz = 48000.0;

double decibels(double ratio) { return 20.0 * std::log10(ratio); }

std::vector<double> samples_of_noise(const NoiseShape& shape, std::size_t count) {
  Noise noise(shape, kRate_hz, 7);
  // A filter begins empty, so its first samples are left out.
  for (int i = 0; i < 24000; ++i) (void)noise.next();
  std::vector<double> samples(count);
  for (double& sample : samples) sample = noise.next();
  return samples;
}

double rms_of(const std::vector<double>& samples) {
  double sum = 0.0;
  for (const double x : samples) sum += x * x;
  return std::sqrt(sum / static_cast<double>(samples.size()));
}

/// The power between two frequencies of pieces of 4800 samples (10 Hz a line), by the sums that
/// define the Fourier transform.
double power_between(const std::vector<double>& samples, double low_hz, double high_hz) {
  constexpr std::size_t kPiece = 4800;
  double power = 0.0;
  std::size_t num_pieces = 0;
  for (std::size_t begin = 0; begin + kPiece <= samples.size(); begin += kPiece, ++num_pieces) {
    for (double hz = low_hz; hz < high_hz; hz += 10.0) {
      // This is the recursion of Goertzel (1958).
      const double twice_cosine = 2.0 * std::cos(2.0 * std::numbers::pi * hz / kRate_hz);
      double one = 0.0, two = 0.0;
      for (std::size_t i = 0; i < kPiece; ++i) {
        const double next = samples[begin + i] + twice_cosine * one - two;
        two = one;
        one = next;
      }
      power += 2.0 * (one * one + two * two - twice_cosine * one * two) /
               (static_cast<double>(kPiece) * static_cast<double>(kPiece));
    }
  }
  return power / static_cast<double>(num_pieces);
}

TEST(SoundLevel, OfASineOfFullScaleIs0) {
  EXPECT_NEAR(rms_of_level(0.0), 0.70711, 1e-5) << "AES17: its root mean square is 1/sqrt(2)";
  EXPECT_NEAR(rms_of_level(-20.0), 0.070711, 1e-6);
  EXPECT_NEAR(level_of_rms(rms_of_level(-37.5)), -37.5, 1e-12);
}

TEST(Biquad, IsTheButterworthFilterOfSecondOrder) {
  const double q = 1.0 / std::numbers::sqrt2;
  const Biquad low = low_pass(1000.0, q, kRate_hz), high = high_pass(1000.0, q, kRate_hz);
  EXPECT_NEAR(decibels(low.gain_at(1000.0, kRate_hz)), -3.0103, 1e-4) << "half the power";
  EXPECT_NEAR(decibels(high.gain_at(1000.0, kRate_hz)), -3.0103, 1e-4);
  EXPECT_NEAR(low.gain_at(0.0, kRate_hz), 1.0, 1e-12);
  EXPECT_NEAR(high.gain_at(24000.0, kRate_hz), 1.0, 1e-12);
  // The bilinear transform gives |H|^2 = 1 / (1 + (tan(pi f / r) / tan(pi c / r))^4).
  for (const double hz : {100.0, 500.0, 2000.0, 8000.0}) {
    const double bent = std::tan(std::numbers::pi * hz / kRate_hz) /
                        std::tan(std::numbers::pi * 1000.0 / kRate_hz);
    EXPECT_NEAR(low.gain_at(hz, kRate_hz), 1.0 / std::sqrt(1.0 + std::pow(bent, 4.0)), 1e-12)
        << hz;
    EXPECT_NEAR(high.gain_at(hz, kRate_hz), 1.0 / std::sqrt(1.0 + std::pow(bent, -4.0)), 1e-12)
        << hz;
  }
}

TEST(Biquad, DoesToASineWhatItsGainSays) {
  Biquad filter = low_pass(1000.0, 0.7, kRate_hz);
  double highest = 0.0;
  for (int i = 0; i < 9600; ++i) {
    const double y = filter.next(std::sin(2.0 * std::numbers::pi * 2000.0 * i / kRate_hz));
    if (i > 4800) highest = std::max(highest, std::abs(y));
  }
  EXPECT_NEAR(highest, filter.gain_at(2000.0, kRate_hz), 1e-3);
}

TEST(NoiseFilter, OfABandLoses3DecibelsAtItsEndsAnd24PerOctaveBeyond) {
  const NoiseFilter filter({.kind = Kind::kBand, .low_hz = 200.0, .high_hz = 3000.0}, kRate_hz);
  EXPECT_NEAR(decibels(filter.gain_at(200.0)), -3.01, 0.01);
  EXPECT_NEAR(decibels(filter.gain_at(3000.0)), -3.01, 0.01);
  EXPECT_NEAR(decibels(filter.gain_at(800.0)), 0.0, 0.01);
  EXPECT_NEAR(decibels(filter.gain_at(100.0)), -24.1, 0.1) << "1 / sqrt(1 + 2^8)";
  EXPECT_NEAR(decibels(filter.gain_at(50.0) / filter.gain_at(25.0)), 24.08, 0.05);
  EXPECT_LT(decibels(filter.gain_at(6000.0)), -24.0);
}

TEST(NoiseFilter, OfPinkNoiseFalls3DecibelsPerOctave) {
  for (const double rate_hz : {44100.0, 48000.0, 96000.0}) {
    const NoiseFilter filter({.kind = Kind::kPink}, rate_hz);
    const auto above_line = [&](double hz) {
      return decibels(filter.gain_at(hz) / filter.gain_at(1000.0)) +
             10.0 * std::log10(hz / 1000.0);
    };
    for (double hz = 100.0; hz < rate_hz / 3.0; hz *= 1.05) {
      EXPECT_NEAR(above_line(hz), 0.0, 0.2) << hz << " Hz at " << rate_hz;
    }
    EXPECT_NEAR(above_line(20.0), -3.0, 0.3) << "what nobody hears is left out";
    EXPECT_LT(above_line(5.0), -20.0);
  }
}

TEST(NoiseFilter, KnowsHowLoudWhiteNoiseComesOut) {
  // An ideal band of 2000 Hz passes 2000 / 24000 of the power. A Butterworth low pass of fourth
  // order passes (pi / 8) / sin(pi / 8) = 1.0262 times its corner, and a high pass removes as
  // much.
  const NoiseFilter band({.kind = Kind::kBand, .low_hz = 1000.0, .high_hz = 3000.0}, kRate_hz);
  EXPECT_NEAR(band.noise_gain() * band.noise_gain() * 24000.0, 1.0262 * 2000.0, 30.0);
  EXPECT_NEAR(NoiseFilter({.kind = Kind::kWhite}, kRate_hz).noise_gain(), 1.0, 1e-12);
}

TEST(NoiseFilter, RefusesWhatFitsNoRate) {
  EXPECT_THROW(NoiseFilter({.kind = Kind::kBand, .low_hz = 300.0, .high_hz = 200.0}, kRate_hz),
               Error);
  EXPECT_THROW(NoiseFilter({.kind = Kind::kBand, .low_hz = 20.0, .high_hz = 20000.0}, 16000.0),
               Error);
  EXPECT_THROW(NoiseFilter({.kind = Kind::kWhite}, 0.0), Error);
  EXPECT_THROW(NoiseFilter({.kind = Kind::kWhite}, std::nan("")), Error);
}

TEST(Noise, HasARootMeanSquareOf1WhateverItsColour) {
  EXPECT_NEAR(rms_of(samples_of_noise({.kind = Kind::kWhite}, 480000)), 1.0, 0.005);
  EXPECT_NEAR(rms_of(samples_of_noise({.kind = Kind::kPink}, 960000)), 1.0, 0.04);
  EXPECT_NEAR(rms_of(samples_of_noise({.kind = Kind::kBand, .low_hz = 200.0, .high_hz = 3000.0},
                                      480000)),
              1.0, 0.02);
}

TEST(Noise, OfWhiteHasNoPeakBeyondTheRootOf3) {
  for (const double x : samples_of_noise({.kind = Kind::kWhite}, 100000)) {
    ASSERT_LE(std::abs(x), std::numbers::sqrt3);
  }
}

TEST(Noise, HasTheSpectrumOfItsColour) {
  const std::vector<double> white = samples_of_noise({.kind = Kind::kWhite}, 192000);
  const double whites = power_between(white, 1000.0, 2000.0);
  EXPECT_NEAR(whites, 1000.0 / 24000.0, 0.1 * 1000.0 / 24000.0);
  EXPECT_NEAR(power_between(white, 8000.0, 9000.0) / whites, 1.0, 0.15);

  const std::vector<double> pink = samples_of_noise({.kind = Kind::kPink}, 192000);
  const double octave = power_between(pink, 500.0, 1000.0);
  EXPECT_NEAR(power_between(pink, 1000.0, 2000.0) / octave, 1.0, 0.2) << "each octave alike";
  EXPECT_NEAR(power_between(pink, 2000.0, 4000.0) / octave, 1.0, 0.2);
}

TEST(Noise, IsTheSameFromTheSameSeedAndAnotherFromAnother) {
  Noise one({}, kRate_hz, 1), same({}, kRate_hz, 1), other({}, kRate_hz, 2);
  int num_equal = 0;
  for (int i = 0; i < 1000; ++i) {
    const double x = one.next();
    EXPECT_EQ(x, same.next());
    num_equal += x == other.next() ? 1 : 0;
  }
  EXPECT_LT(num_equal, 3);
}

}  // namespace noise_test
}  // namespace jnd::core
