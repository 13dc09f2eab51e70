#pragma once

#include <algorithm>
#include <cstdint>

namespace jnd::device {

/// For how long a real-time loop spins before a tick is due, learnt from how late the machine
/// wakes it up: as short as it can be while all but one wake-up in 2000 come in time. A
/// wake-up that came too late makes it longer by 20 us, any other shorter by 10 ns; in balance
/// (Robbins and Monro, 1951) one in 2000 is too late. It begins at the longest, so that the
/// first ticks are punctual too. Real time.
class AdaptiveSpin {
 public:
  /// Never longer than `max_ns` >= 0, nor than half of `period_ns` > 0: the rest of the CPU is
  /// for others, and the kernel interrupts a real-time thread that never sleeps.
  AdaptiveSpin(std::int64_t max_ns, std::int64_t period_ns) noexcept
      : max_ns_(std::min(max_ns, period_ns / 2)), length_ns_(max_ns_) {}

  [[nodiscard]] std::int64_t length_ns() const noexcept { return length_ns_; }

  /// The thread ran again this long after the time that it had asked for.
  void woke_up_late_by(std::int64_t latency_ns) noexcept {
    const bool too_late = latency_ns + kReserveNs > length_ns_;
    length_ns_ =
        std::clamp<std::int64_t>(length_ns_ + (too_late ? kLongerNs : -kShorterNs), 0, max_ns_);
  }

 private:
  static constexpr std::int64_t kLongerNs = 20'000;
  static constexpr std::int64_t kShorterNs = 10;
  static constexpr std::int64_t kReserveNs = 5'000;  ///< To warm up in.

  std::int64_t max_ns_;
  std::int64_t length_ns_;
};

}  // namespace jnd::device
