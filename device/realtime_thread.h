#pragma once

#include <atomic>
#include <semaphore>
#include <string>
#include <thread>

#include "device/haptic_loop.h"
#include "device/loop_timing.h"

namespace jnd::device {

/// What the thread was really given.
struct RealtimeReport {
  bool realtime_scheduler = false;  ///< SCHED_FIFO at the priority asked for.
  std::string scheduler;            ///< "SCHED_FIFO 80" or "SCHED_OTHER".
  bool memory_locked = false;
  bool pinned = false;  ///< To the CPU asked for; false if none was.
  std::string lacks;    ///< What was asked for and not given, and how to get it; else empty.
};

/// Drives a `HapticLoop` by absolute time: sleeps until shortly before each tick is due and
/// spins the rest. A tick that comes too late by whole periods is counted as missed ticks and
/// the grid is kept; the loop never runs several ticks at once to catch up.
///
/// The thread is prepared in the constructor, before anything moves: look at `report()`, decide
/// with `require_realtime`, open the device, then `start`.
class RealtimeThread {
 public:
  struct Parameters {
    int priority = 80;        ///< Of SCHED_FIFO, [1, 99]; 0 does not ask for it.
    bool lock_memory = true;  ///< Of the whole process.
    int cpu = -1;             ///< To pin to; -1: any.
    double spin_s = 50e-6;    ///< Spun before each tick instead of slept, >= 0.
  };

  /// Throws `core::Error` for a parameter out of range. Not real time.
  explicit RealtimeThread(const Parameters& parameters);
  /// Stops.
  ~RealtimeThread();
  RealtimeThread(const RealtimeThread&) = delete;
  RealtimeThread& operator=(const RealtimeThread&) = delete;

  [[nodiscard]] const RealtimeReport& report() const noexcept { return report_; }

  /// Ticks until `stop`; `loop` has to live until then. Once only.
  void start(HapticLoop& loop) noexcept;
  /// Returns when the last tick is over and the thread has ended. May be called twice.
  void stop() noexcept;

  [[nodiscard]] const LoopTiming& timing() const noexcept { return timing_; }

 private:
  void prepare() noexcept;
  void run() noexcept;

  Parameters parameters_;
  RealtimeReport report_;
  LoopTiming timing_;
  HapticLoop* loop_ = nullptr;
  std::atomic<bool> stop_{false};
  std::binary_semaphore prepared_{0};
  std::binary_semaphore go_{0};
  std::thread thread_;
};

/// Throws `core::Error` if a real device would be driven without a real-time scheduler and
/// locked memory, unless `allow_no_realtime`. Call it before `HapticDevice::open`.
void require_realtime(const HapticDevice& device, const RealtimeReport& report,
                      bool allow_no_realtime);

}  // namespace jnd::device
