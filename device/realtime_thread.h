#pragma once

#include <atomic>
#include <semaphore>
#include <thread>

#include "device/adaptive_spin.h"
#include "device/haptic_loop.h"
#include "device/loop_timing.h"
#include "device/realtime_report.h"

namespace jnd::device {

/// Drives a `HapticLoop` by absolute time: sleeps until shortly before each tick is due and
/// spins the rest, see `AdaptiveSpin`. A tick that comes too late by whole periods is counted
/// as missed ticks and the grid is kept; the loop never runs several ticks at once to catch up.
///
/// Where the device sets the pace, a tick begins when it has measured, and half a period later
/// if it has not; the grid follows it.
///
/// The thread is prepared in the constructor, before anything moves: look at `report()`, then
/// `start_haptics`.
class RealtimeThread {
 public:
  struct Parameters {
    int priority = 80;        ///< Of SCHED_FIFO, [1, 99]; 0 does not ask for it.
    bool lock_memory = true;  ///< Locks the memory of the whole process.
    int cpu = -1;             ///< To pin to; -1: any.
    /// Spun before each tick instead of slept, at most, >= 0; 0: sleep only. Never more than
    /// half a period.
    double max_spin_s = 200e-6;
    /// Where `cpu` is -1, until `stop`: see `ClearedCpu`.
    bool clear_cpu = false;
    /// Lost between two ticks, so much is a fault of the loop, >= 0; 0: never.
    double max_stall_s = 0.0;
    bool keep_cpus_awake = true;  ///< Where it is allowed, until `stop`: see `AwakeCpus`.
    /// The clock that goes on while the machine sleeps, which the monotonic one does not: more
    /// between the two than at the start is a fault of the loop. nullptr: CLOCK_BOOTTIME.
    std::int64_t (*boottime_ns)() noexcept = nullptr;
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
  /// Returns when the last tick is over and the thread has ended. May be called twice, and
  /// without `start`.
  void stop() noexcept;

  [[nodiscard]] const LoopTiming& timing() const noexcept { return timing_; }
  /// What the ticking used, without start and stop. Call it after `stop`.
  [[nodiscard]] const ThreadUse& use() const noexcept { return use_; }

 private:
  void prepare() noexcept;
  void run() noexcept;
  [[nodiscard]] std::int64_t wait_until_due(std::int64_t due_ns, AdaptiveSpin& spin) noexcept;
  struct TickBegin {
    std::int64_t due_ns = 0;  ///< When the device had measured, or our clock said so.
    std::int64_t started_ns = 0;
  };
  [[nodiscard]] TickBegin wait_for_device(std::int64_t& due_ns,
                                          std::int64_t period_ns) noexcept;

  Parameters parameters_;
  RealtimeReport report_;
  AwakeCpus awake_cpus_;
  ClearedCpu cleared_cpu_;
  LoopTiming timing_;
  ThreadUse use_;
  HapticLoop* loop_ = nullptr;
  std::atomic<bool> stop_{false};
  std::binary_semaphore prepared_{0};
  std::binary_semaphore go_{0};
  std::thread thread_;
};

/// Throws `core::Error` if a real device would be driven without a real-time scheduler and
/// locked memory, or watched without such a scheduler, unless `allow_no_realtime`. `watchdog`:
/// of the watchdog's thread; nullptr: nobody watches. Call it before `HapticDevice::open`.
void require_realtime(const HapticDevice& device, const RealtimeReport& report,
                      bool allow_no_realtime, const RealtimeReport* watchdog = nullptr);

/// The one order that is safe: `require_realtime`, then motors, then ticks. Throws
/// `core::Error` of the first that fails; then the device is closed and not one tick was run.
/// Not real time.
void start_haptics(HapticDevice& device, HapticLoop& loop, RealtimeThread& thread,
                   bool allow_no_realtime, const RealtimeReport* watchdog = nullptr);

}  // namespace jnd::device
