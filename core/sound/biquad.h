#pragma once

namespace jnd::core {

/// A filter of second order, in the transposed direct form II:
/// y[n] = b0 x[n] + b1 x[n-1] + b2 x[n-2] - a1 y[n-1] - a2 y[n-2]. Real time.
struct Biquad {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;

  [[nodiscard]] double next(double x) noexcept {
    const double y = b0 * x + first_;
    first_ = b1 * x - a1 * y + second_;
    second_ = b2 * x - a2 * y;
    return y;
  }

  /// Returns the ratio of amplitudes for a sine of this frequency.
  [[nodiscard]] double gain_at(double frequency_hz, double rate_hz) const noexcept;

 private:
  double first_ = 0.0, second_ = 0.0;
};

// Low and high pass of quality q by the bilinear transform, prewarped so that the corner is at
// `corner_hz`: Audio EQ Cookbook (Bristow-Johnson; W3C Note of 8 June 2021). q = 1/sqrt(2)
// gives a Butterworth filter of second order. `corner_hz` is in (0, rate_hz / 2). Not real
// time.

[[nodiscard]] Biquad low_pass(double corner_hz, double q, double rate_hz);
[[nodiscard]] Biquad high_pass(double corner_hz, double q, double rate_hz);

}  // namespace jnd::core
