#include "device/realtime_thread.h"

#include <sched.h>
#include <sys/mman.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <string>

#include "core/clock.h"
#include "core/error.h"
#include "core/require.h"
#include "device/sleep_watch.h"

namespace jnd::device {
namespace {

using core::kNsPerS;

std::int64_t time_ns(clockid_t clock) noexcept {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNsPerS + now.tv_nsec;
}

std::int64_t monotonic_ns() noexcept { return time_ns(CLOCK_MONOTONIC); }

void sleep_until(std::int64_t until_ns) noexcept {
  const timespec until{.tv_sec = static_cast<time_t>(until_ns / kNsPerS),
                       .tv_nsec = static_cast<long>(until_ns % kNsPerS)};
  // A signal woke it early, so it sleeps on.
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
  }
}

/// It uses no pause instruction, because under a hypervisor too many of them give the CPU away.
std::int64_t spin_until(std::int64_t until_ns) noexcept {
  std::int64_t now_ns = monotonic_ns();
  while (now_ns < until_ns) now_ns = monotonic_ns();
  return now_ns;
}

}  // namespace

RealtimeThread::RealtimeThread(const Parameters& parameters) : parameters_(parameters) {
  core::require(parameters.priority >= 0 && parameters.priority <= 99, "priority",
                "a number in [0, 99]", parameters.priority);
  core::require(parameters.cpu >= -1 && parameters.cpu < CPU_SETSIZE, "cpu",
                "the number of a CPU, or -1", parameters.cpu);
  core::require(parameters.max_spin_s >= 0.0 && parameters.max_spin_s <= 1.0, "max_spin_s",
                "a number in [0, 1]", parameters.max_spin_s);
  core::require(parameters.max_stall_s >= 0.0 && parameters.max_stall_s <= 3600.0,
                "max_stall_s", "a number in [0, 3600]", parameters.max_stall_s);
  thread_ = std::thread([this] {
    prepare();
    prepared_.release();
    go_.acquire();
    if (!stop_.load(std::memory_order_acquire)) run();
  });
  prepared_.acquire();
}

RealtimeThread::~RealtimeThread() { stop(); }

void RealtimeThread::start(HapticLoop& loop) noexcept {
  if (loop_ != nullptr) return;
  loop_ = &loop;
  go_.release();
}

void RealtimeThread::stop() noexcept {
  if (!thread_.joinable()) return;
  stop_.store(true, std::memory_order_release);
  if (loop_ == nullptr) go_.release();
  thread_.join();
  awake_cpus_.release();
  cleared_cpu_.release();
  if (report_.memory_locked) munlockall();
}

void RealtimeThread::prepare() noexcept {
  obtain_scheduler(parameters_.priority, report_);
  if (parameters_.lock_memory) obtain_locked_memory(report_);
  obtain_cpu(parameters_.cpu, report_);
  if (parameters_.clear_cpu && parameters_.cpu < 0) cleared_cpu_.obtain(report_);
  if (parameters_.keep_cpus_awake) awake_cpus_.obtain(report_);
  prefault_stack();
  // The page of the kernel's clock is missing until it is read, because locking leaves it out.
  (void)monotonic_ns();
  flush_denormals();
}

/// Waits by our own clock. Returns the time when the tick begins.
std::int64_t RealtimeThread::wait_until_due(std::int64_t due_ns, AdaptiveSpin& spin) noexcept {
  const std::int64_t wake_up_ns = due_ns - spin.length_ns();
  if (wake_up_ns > monotonic_ns()) {
    sleep_until(wake_up_ns);
    spin.woke_up_late_by(monotonic_ns() - wake_up_ns);
  }
  // The warming comes at the last moment, because other cores that share the cache keep
  // displacing data.
  constexpr std::int64_t kWarmingNs = 5'000;  // Several times what it takes.
  if (monotonic_ns() < due_ns - kWarmingNs) {
    spin_until(due_ns - kWarmingNs);
    loop_->warm();
  }
  return spin_until(due_ns);
}

/// Waits by the device's clock. The grid follows it slowly, so a measurement may come half a
/// period early or late. But a device whose clock runs wild makes the loop faster by a
/// sixteenth at most, because the force limits count ticks.
RealtimeThread::TickBegin RealtimeThread::wait_for_device(std::int64_t& due_ns,
                                                          std::int64_t period_ns) noexcept {
  constexpr std::int64_t kSlowness = 8;
  const std::int64_t half_ns = period_ns / 2;
  if (monotonic_ns() < due_ns - half_ns) sleep_until(due_ns - half_ns);
  const bool has_measured = loop_->wait_for_sample(due_ns + half_ns);
  const std::int64_t now_ns = monotonic_ns();
  TickBegin begin{.due_ns = has_measured ? now_ns : due_ns, .started_ns = now_ns};
  if (now_ns <= due_ns + half_ns) due_ns += (now_ns - due_ns) / kSlowness;
  return begin;
}

void RealtimeThread::run() noexcept {
  const ThreadUse at_start = thread_use();
  const std::int64_t period_ns =
      std::max<std::int64_t>(1, std::llround(1e9 * loop_->period_s()));
  const std::int64_t max_stall_ns = parameters_.max_stall_s > 0.0
                                        ? std::llround(1e9 * parameters_.max_stall_s)
                                        : std::numeric_limits<std::int64_t>::max();
  SleepWatch sleep(parameters_.boottime_ns);
  AdaptiveSpin spin(std::llround(1e9 * parameters_.max_spin_s), period_ns);
  std::int64_t due_ns = monotonic_ns() + period_ns;
  std::int64_t num_missed = 0;  // Before the next tick.
  while (!stop_.load(std::memory_order_relaxed)) {
    const TickBegin begin =
        loop_->is_paced()
            ? wait_for_device(due_ns, period_ns)
            : TickBegin{.due_ns = due_ns, .started_ns = wait_until_due(due_ns, spin)};
    const std::int64_t started_ns = begin.started_ns;
    if (sleep.has_slept()) loop_->suspended();
    if (started_ns - due_ns >= max_stall_ns) loop_->stalled();
    // The thread woke up late by whole periods. This tick is that of the present time; the
    // others never ran.
    const std::int64_t num_overslept =
        std::max<std::int64_t>(0, started_ns - due_ns) / period_ns;
    timing_.record_missed(num_overslept);
    loop_->due(started_ns, num_missed + num_overslept);
    loop_->render();
    const std::int64_t written_ns = monotonic_ns();
    loop_->report();
    const std::int64_t ended_ns = monotonic_ns();
    timing_.record_tick(written_ns - begin.due_ns, ended_ns - started_ns);

    due_ns += (1 + num_overslept) * period_ns;
    num_missed = 0;
    if (ended_ns >= due_ns + period_ns) {
      num_missed = (ended_ns - due_ns) / period_ns;
      timing_.record_missed(num_missed);
      // The tick was held up inside of the device, whose force persisted for as long.
      if (num_missed * period_ns >= max_stall_ns) loop_->stalled();
      due_ns += num_missed * period_ns;
    }
  }
  const ThreadUse at_end = thread_use();
  use_ = {.num_page_faults = at_end.num_page_faults - at_start.num_page_faults,
          .cpu_time_s = at_end.cpu_time_s - at_start.cpu_time_s};
}

void require_realtime(const HapticDevice& device, const RealtimeReport& report,
                      bool allow_no_realtime, const RealtimeReport* watchdog) {
  if (device.capabilities().simulated || allow_no_realtime) return;
  if (watchdog != nullptr && !watchdog->realtime_scheduler) {
    throw core::Error(
        std::string(device.name()) +
        ": expected a real-time scheduler for the watchdog before its motors turn "
        "on, found " +
        watchdog->scheduler +
        "; raise the limit rtprio above the loop's priority, or allow it with "
        "--allow-no-realtime, which is stored with the session");
  }
  if (report.realtime_scheduler && report.memory_locked) return;
  throw core::Error(std::string(device.name()) +
                    ": expected a real-time scheduler and locked memory before its motors turn "
                    "on, found " +
                    report.scheduler +
                    (report.memory_locked ? ", memory locked" : ", memory not locked") +
                    "; allow it with --allow-no-realtime, which is stored with the session");
}

void start_haptics(HapticDevice& device, HapticLoop& loop, RealtimeThread& thread,
                   bool allow_no_realtime, const RealtimeReport* watchdog) {
  require_realtime(device, thread.report(), allow_no_realtime, watchdog);
  try {
    device.open();
  } catch (...) {
    // The device may have opened half way.
    device.close();
    throw;
  }
  thread.start(loop);
}

}  // namespace jnd::device
