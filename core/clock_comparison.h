#pragma once

#include <cstdint>
#include <optional>

namespace jnd::core {

/// Tells how a device's clock runs compared with ours. Trivially copyable.
struct ClockDrift {
  /// Rate by which the device's clock is faster; below 0 it is slower.
  double drift_ppm = 0.0;
  /// Standard deviation of the clock's differences about the straight line.
  double residual_s = 0.0;
  double observed_s = 0.0;  ///< Duration of the comparison, by our clock.
};

/// Compares a device's clock with ours. Each measurement gives a pair: the device's time of it,
/// and our time when it arrived. Our time is late by the transfer, which is never negative and
/// mostly short. So of each second only the pair with the least delay counts, as in NTP's clock
/// filter (RFC 5905 section 10). A straight line is fitted through these pairs by least
/// squares. When a clock is set or a device is restarted, a new line begins. Real time, no
/// heap.
class ClockComparison {
 public:
  void observe(std::int64_t ours_ns, std::int64_t device_ns) noexcept;

  /// Returns no value until ten seconds have pairs.
  [[nodiscard]] std::optional<ClockDrift> drift() const noexcept;

 private:
  struct Pair {
    std::int64_t ours_ns = 0;
    std::int64_t ahead_ns = 0;  ///< The device's time minus ours, both since the line began.
  };
  void begin(std::int64_t ours_ns, std::int64_t device_ns) noexcept;
  void end_second() noexcept;

  bool has_begun_ = false;
  std::int64_t first_ours_ns_ = 0, first_device_ns_ = 0;
  std::int64_t second_ends_ns_ = 0;
  Pair best_;  ///< Best pair of the current second.
  bool has_best_ = false;
  // Sums for the least squares of `ahead` on our time, in seconds, about the running means
  // (Welford, 1962).
  double num_ = 0.0, mean_x_ = 0.0, mean_y_ = 0.0, sum_xx_ = 0.0, sum_xy_ = 0.0, sum_yy_ = 0.0;
};

}  // namespace jnd::core
