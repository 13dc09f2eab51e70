#include "core/clock_comparison.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "core/clock.h"

namespace jnd::core {
namespace {

/// A larger step between two measurements means that a clock was set: no clock drifts this far
/// in between, and no transfer takes this long.
constexpr std::int64_t kLeap_ns = kNsPerS / 2;
/// This is 73 years. A difference beyond it is no valid time, and could overflow in a sum.
constexpr std::int64_t kFar_ns = std::numeric_limits<std::int64_t>::max() / 4;
constexpr double kFewestSeconds = 10.0;

}  // namespace

void ClockComparison::begin(std::int64_t ours_ns, std::int64_t device_ns) noexcept {
  *this = {};
  has_begun_ = true;
  first_ours_ns_ = ours_ns;
  first_device_ns_ = device_ns;
  second_ends_ns_ = kNsPerS;
}

void ClockComparison::observe(std::int64_t ours_ns, std::int64_t device_ns) noexcept {
  if (!has_begun_) begin(ours_ns, device_ns);
  // The subtraction is unsigned, because a device may report any time and a signed one could
  // overflow.
  const auto since = [](std::int64_t now_ns, std::int64_t first_ns) {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(now_ns) -
                                     static_cast<std::uint64_t>(first_ns));
  };
  const std::int64_t ours = since(ours_ns, first_ours_ns_);
  const auto ahead =
      static_cast<std::int64_t>(static_cast<std::uint64_t>(since(device_ns, first_device_ns_)) -
                                static_cast<std::uint64_t>(ours));
  const bool is_a_time = ours >= 0 && ours < kFar_ns && ahead > -kFar_ns && ahead < kFar_ns;
  if (!is_a_time || (has_best_ && std::abs(ahead - best_.ahead_ns) > kLeap_ns)) {
    return begin(ours_ns, device_ns);
  }
  if (ours >= second_ends_ns_) {
    end_second();
    second_ends_ns_ = (ours / kNsPerS + 1) * kNsPerS;
  }
  // The measurement whose clock is furthest ahead had the shortest transfer.
  if (has_best_ && ahead <= best_.ahead_ns) return;
  best_ = {.ours_ns = ours, .ahead_ns = ahead};
  has_best_ = true;
}

void ClockComparison::end_second() noexcept {
  if (!has_best_) return;
  const double x = 1e-9 * static_cast<double>(best_.ours_ns);
  const double y = 1e-9 * static_cast<double>(best_.ahead_ns);
  has_best_ = false;
  num_ += 1.0;
  const double from_x = x - mean_x_, from_y = y - mean_y_;
  mean_x_ += from_x / num_;
  mean_y_ += from_y / num_;
  sum_xx_ += from_x * (x - mean_x_);
  sum_xy_ += from_x * (y - mean_y_);
  sum_yy_ += from_y * (y - mean_y_);
}

std::optional<ClockDrift> ClockComparison::drift() const noexcept {
  if (num_ < kFewestSeconds || !(sum_xx_ > 0.0)) return std::nullopt;
  const double slope = sum_xy_ / sum_xx_;
  const double unexplained = std::max(0.0, sum_yy_ - slope * sum_xy_);
  return ClockDrift{.drift_ppm = 1e6 * slope,
                    .residual_s = std::sqrt(unexplained / (num_ - 2.0)),
                    .observed_s = num_};
}

}  // namespace jnd::core
