#pragma once

#include <cstdint>
#include <optional>

namespace jnd::core {

/// How a device's clock runs beside ours. Trivially copyable.
struct ClockDrift {
  double drift_ppm = 0.0;   ///< By which the device's is faster; below 0: slower.
  double residual_s = 0.0;  ///< Standard deviation about the straight line.
  double observed_s = 0.0;  ///< Over which it was measured, by our clock.
};

/// Compares a device's clock with ours, by pairs of both for each measurement: the device's
/// time of it, and ours when it came. That is late by the way here, which is never negative and
/// mostly short, so of each second the pair with the least delay counts (as NTP's clock filter
/// has it, RFC 5905 section 10). Through these a straight line, by least squares. A clock
/// that is set, or a device that is started anew, begins the line anew. Real time, no heap.
class ClockComparison {
 public:
  void observe(std::int64_t ours_ns, std::int64_t device_ns) noexcept;

  /// None before ten seconds of pairs.
  [[nodiscard]] std::optional<ClockDrift> drift() const noexcept;

 private:
  struct Pair {
    std::int64_t ours_ns = 0;
    std::int64_t ahead_ns = 0;  ///< The device's less ours, since the line began.
  };
  void begin(std::int64_t ours_ns, std::int64_t device_ns) noexcept;
  void end_second() noexcept;

  bool has_begun_ = false;
  std::int64_t first_ours_ns_ = 0, first_device_ns_ = 0;
  std::int64_t second_ends_ns_ = 0;
  Pair best_;  ///< Of this second, since the line began.
  bool has_best_ = false;
  // Least squares of ahead on ours, in seconds, about the means so far (Welford, 1962).
  double num_ = 0.0, mean_x_ = 0.0, mean_y_ = 0.0, sum_xx_ = 0.0, sum_xy_ = 0.0, sum_yy_ = 0.0;
};

}  // namespace jnd::core
