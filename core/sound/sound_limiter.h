#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace jnd::core {

/// The last stage of all sound. No sample leaves it beyond the ceiling, and a sample that is
/// not a number leaves it as silence. If a peak would be too high, it turns the whole sound
/// down at once, and up again with a time constant of 50 ms, so that nothing is cut off and
/// nothing clips. Real time.
class SoundLimiter {
 public:
  /// -1 dBFS, so that a converter that interpolates between samples does not clip either.
  static constexpr double kCeiling = 0.891;

  explicit SoundLimiter(double rate_hz) noexcept
      : recovery_(1.0 - std::exp(-1.0 / (0.050 * rate_hz))) {}

  [[nodiscard]] double next(double x) noexcept {
    const double peak = std::abs(x);
    if (!(peak <= 1e6)) {
      ++num_limited_;
      return 0.0;
    }
    gain_ += recovery_ * (1.0 - gain_);
    if (peak * gain_ > kCeiling) {
      gain_ = kCeiling / peak;
      ++num_limited_;
    }
    return std::clamp(gain_ * x, -kCeiling, kCeiling);
  }

  /// Returns the number of samples that would have been too high.
  [[nodiscard]] std::int64_t num_limited() const noexcept { return num_limited_; }

 private:
  double recovery_;
  double gain_ = 1.0;
  std::int64_t num_limited_ = 0;
};

}  // namespace jnd::core
