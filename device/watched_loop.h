#pragma once

#include <optional>

#include "core/safety/watchdog_state.h"
#include "device/haptic_device.h"
#include "device/haptic_loop.h"
#include "device/realtime_thread.h"
#include "device/watchdog.h"

namespace jnd::device {

/// A device that is open, with its haptic loop in real time and a watchdog beside it, from
/// construction until `stop`: the one way to open a device in real time, whatever for. Not real
/// time itself; used by one thread.
class WatchedLoop {
 public:
  struct Parameters {
    bool allow_no_realtime = false;  ///< A real device also without real-time rights.
    int cpu = -1;                    ///< To pin the loop to; -1: any.
    bool clear_cpu = false;          ///< Where `cpu` is -1: see `ClearedCpu`.
  };

  /// `loop` drives `device`, and its exchange has a heartbeat and `watched` as the watchdog's
  /// state; all of them outlive this. Throws `core::Error`: no real-time rights for a real
  /// device, a CPU that is not to be had, a device that does not open, a loop that nobody
  /// watches over. Then the device is closed and not one tick was run.
  WatchedLoop(HapticDevice& device, HapticLoop& loop, core::WatchdogState& watched,
              const Parameters& parameters);
  ~WatchedLoop() { stop(); }
  WatchedLoop(const WatchedLoop&) = delete;
  WatchedLoop& operator=(const WatchedLoop&) = delete;

  /// The last tick is over, the force is gone and the device closed when this returns. May be
  /// called twice.
  void stop() noexcept;

  [[nodiscard]] const RealtimeThread& thread() const noexcept { return thread_; }

 private:
  HapticDevice& device_;
  RealtimeThread thread_;
  std::optional<WatchdogThread> watchdog_;
};

}  // namespace jnd::device
