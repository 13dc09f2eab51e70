#pragma once

#include <optional>

#include "core/safety/watchdog_state.h"
#include "device/haptic_device.h"
#include "device/haptic_loop.h"
#include "device/realtime_thread.h"
#include "device/watchdog.h"

namespace jnd::device {

/// An open device with its haptic loop in real time and a watchdog beside it, from construction
/// until `stop`. This is the only way to open a device in real time, for any purpose. Its own
/// functions are not real time; one thread may use it.
class WatchedLoop {
 public:
  struct Parameters {
    bool allow_no_realtime = false;  ///< Allows a real device without real-time rights.
    int cpu = -1;                    ///< CPU to which the loop is pinned; -1 for any.
    bool clear_cpu = false;          ///< If `cpu` is -1: see `ClearedCpu`.
  };

  /// `loop` drives `device`, and its exchange has a heartbeat and `watched` as the watchdog's
  /// state. All of them must outlive this object. Throws `core::Error` if a real device has no
  /// real-time rights, a CPU is not available, the device does not open, or nobody watches the
  /// loop. Then the device is closed and no tick has run.
  WatchedLoop(HapticDevice& device, HapticLoop& loop, core::WatchdogState& watched,
              const Parameters& parameters);
  ~WatchedLoop() { stop(); }
  WatchedLoop(const WatchedLoop&) = delete;
  WatchedLoop& operator=(const WatchedLoop&) = delete;

  /// When it returns, the last tick is over, the force is gone and the device is closed. It may
  /// be called twice.
  void stop() noexcept;

  [[nodiscard]] const RealtimeThread& thread() const noexcept { return thread_; }

 private:
  HapticDevice& device_;
  RealtimeThread thread_;
  std::optional<WatchdogThread> watchdog_;
};

}  // namespace jnd::device
