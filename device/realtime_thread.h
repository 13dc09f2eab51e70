#pragma once

#include <atomic>
#include <semaphore>
#include <thread>

#include "device/adaptive_spin.h"
#include "device/haptic_loop.h"
#include "device/loop_timing.h"
#include "device/realtime_report.h"

namespace jnd::device {

/// Drives a `HapticLoop` by absolute time. It sleeps until shortly before each tick is due and
/// spins the rest, see `AdaptiveSpin`. A tick that is late by whole periods counts as missed
/// ticks, and the grid is kept. The loop never runs several ticks at once to catch up.
///
/// If the device sets the pace, a tick begins when the device has measured, or half a period
/// after that was expected. The grid follows the device.
///
/// The constructor prepares the thread before anything moves. Check `report()`, then call
/// `start_haptics`.
class RealtimeThread {
 public:
  struct Parameters {
    int priority = 80;        ///< Of SCHED_FIFO, [1, 99]; 0 does not request it.
    bool lock_memory = true;  ///< Locks the memory of the whole process.
    int cpu = -1;             ///< CPU to which it is pinned; -1 for any.
    /// Longest time that is spun before each tick instead of slept, >= 0; 0 only sleeps. It is
    /// never more than half a period.
    double max_spin_s = 200e-6;
    /// If `cpu` is -1, until `stop`: see `ClearedCpu`.
    bool clear_cpu = false;
    /// If more time is lost between two ticks, that is a fault of the loop, >= 0; 0 for never.
    double max_stall_s = 0.0;
    bool keep_cpus_awake = true;  ///< If allowed, until `stop`: see `AwakeCpus`.
    /// The clock that continues while the machine sleeps, which the monotonic clock does not.
    /// If their difference grows after the start, that is a fault of the loop. nullptr uses
    /// CLOCK_BOOTTIME.
    std::int64_t (*boottime_ns)() noexcept = nullptr;
  };

  /// Throws `core::Error` for a parameter out of range. Not real time.
  explicit RealtimeThread(const Parameters& parameters);
  /// Stops the thread.
  ~RealtimeThread();
  RealtimeThread(const RealtimeThread&) = delete;
  RealtimeThread& operator=(const RealtimeThread&) = delete;

  [[nodiscard]] const RealtimeReport& report() const noexcept { return report_; }

  /// Runs ticks until `stop`; `loop` must live until then. Call it once only.
  void start(HapticLoop& loop) noexcept;
  /// Returns when the last tick is over and the thread has ended. It may be called twice, and
  /// without `start`.
  void stop() noexcept;

  [[nodiscard]] const LoopTiming& timing() const noexcept { return timing_; }
  /// Returns what the ticks used, without start and stop. Call it after `stop`.
  [[nodiscard]] const ThreadUse& use() const noexcept { return use_; }

 private:
  void prepare() noexcept;
  void run() noexcept;
  [[nodiscard]] std::int64_t wait_until_due(std::int64_t due_ns, AdaptiveSpin& spin) noexcept;
  struct TickBegin {
    /// When the device had measured, or when the tick was due by our clock.
    std::int64_t due_ns = 0;
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
/// locked memory, or watched without such a scheduler, unless `allow_no_realtime`. `watchdog`
/// is the report of the watchdog's thread, or nullptr without a watchdog. Call it before
/// `HapticDevice::open`.
void require_realtime(const HapticDevice& device, const RealtimeReport& report,
                      bool allow_no_realtime, const RealtimeReport* watchdog = nullptr);

/// Starts in the only safe order: `require_realtime`, then motors, then ticks. Throws the
/// `core::Error` of the first step that fails; then the device is closed and no tick has run.
/// Not real time.
void start_haptics(HapticDevice& device, HapticLoop& loop, RealtimeThread& thread,
                   bool allow_no_realtime, const RealtimeReport* watchdog = nullptr);

}  // namespace jnd::device
