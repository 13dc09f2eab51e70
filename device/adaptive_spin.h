#pragma once

#include <algorithm>
#include <cstdint>

namespace jnd::device {

/// Learns for how long a real-time loop has to spin before a tick is due, from how late the
/// machine wakes it. The spin is as short as possible while all but one wake-up in 2000 come in
/// time. A wake-up that is too late lengthens it by 20 us, any other shortens it by 10 ns, so
/// in balance one in 2000 is too late (Robbins and Monro, 1951). It begins at its longest, so
/// that the first ticks are punctual, too. Real time.
class AdaptiveSpin {
 public:
  /// The spin is never longer than `max_ns` >= 0, nor than half of `period_ns` > 0. The rest of
  /// the CPU's time is for others, and the kernel interrupts a real-time thread that never
  /// sleeps.
  AdaptiveSpin(std::int64_t max_ns, std::int64_t period_ns) noexcept
      : max_ns_(std::min(max_ns, period_ns / 2)), length_ns_(max_ns_) {}

  [[nodiscard]] std::int64_t length_ns() const noexcept { return length_ns_; }

  /// Tells how long after the requested time the thread ran again.
  void woke_up_late_by(std::int64_t latency_ns) noexcept {
    const bool too_late = latency_ns + kReserveNs > length_ns_;
    length_ns_ =
        std::clamp<std::int64_t>(length_ns_ + (too_late ? kLongerNs : -kShorterNs), 0, max_ns_);
  }

 private:
  static constexpr std::int64_t kLongerNs = 20'000;
  static constexpr std::int64_t kShorterNs = 10;
  static constexpr std::int64_t kReserveNs = 5'000;  ///< Time to warm the caches.

  std::int64_t max_ns_;
  std::int64_t length_ns_;
};

}  // namespace jnd::device
