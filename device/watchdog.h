#pragma once

#include <atomic>
#include <cstdint>
#include <semaphore>
#include <thread>

#include "core/safety/watchdog_state.h"
#include "device/haptic_device.h"
#include "device/realtime_report.h"

namespace jnd::device {

/// Takes the force away from a device whose loop has stopped, because it is stuck, starved or
/// dead. It begins to watch with the loop's first beat. A silent loop is bitten again after
/// each timeout, so that the force ends even if a halt gets lost.
///
/// It uses no wall clock: a thread or a test passes the time to `look`.
class Watchdog {
 public:
  struct Parameters {
    double timeout_s = 0.020;  ///< Longest allowed silence, in (0, 10].
  };

  /// Throws `core::Error` naming the field. Device and state must outlive this object. Not real
  /// time.
  Watchdog(const Parameters& parameters, HapticDevice& device, core::WatchdogState& state);

  /// Call it several times within the timeout, from one thread, with a clock that never goes
  /// back. It bites at the first look that comes a timeout or more after the look that saw the
  /// last beat. Real time.
  void look(std::int64_t now_ns) noexcept;

 private:
  std::int64_t timeout_ns_;
  HapticDevice& device_;
  core::WatchdogState& state_;
  std::uint64_t last_beats_ = 0;
  std::int64_t silent_since_ns_ = 0;
};

/// A `Watchdog` with a thread of its own, which looks ten times within the timeout. It asks for
/// a higher priority than the loop's, so that a loop that never sleeps cannot starve it.
class WatchdogThread {
 public:
  struct Parameters {
    Watchdog::Parameters watchdog;
    int priority = 81;  ///< Of SCHED_FIFO, [1, 99]; 0 does not request it.
  };

  /// Watches until this object is destroyed. Throws `core::Error` naming the field. Not real
  /// time.
  WatchdogThread(const Parameters& parameters, HapticDevice& device,
                 core::WatchdogState& state);
  ~WatchdogThread();
  WatchdogThread(const WatchdogThread&) = delete;
  WatchdogThread& operator=(const WatchdogThread&) = delete;

  /// Returns what its thread was granted. Without a real-time scheduler it cannot keep the
  /// timeout.
  [[nodiscard]] const RealtimeReport& report() const noexcept { return report_; }

 private:
  void run() noexcept;

  Watchdog watchdog_;
  std::int64_t period_ns_;
  int priority_;
  RealtimeReport report_;
  std::binary_semaphore prepared_{0};
  std::atomic<bool> stop_{false};
  std::thread thread_;
};

}  // namespace jnd::device
