#include "device/realtime_thread.h"

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <time.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>

#include "core/error.h"
#include "core/require.h"

namespace jnd::device {
namespace {

constexpr std::int64_t kNsPerS = 1'000'000'000;

std::int64_t monotonic_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<std::int64_t>(now.tv_sec) * kNsPerS + now.tv_nsec;
}

void sleep_until(std::int64_t time_ns) noexcept {
  const timespec until{.tv_sec = static_cast<time_t>(time_ns / kNsPerS),
                       .tv_nsec = static_cast<long>(time_ns % kNsPerS)};
  // Woken early by a signal: sleep on.
  while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) != 0) {
  }
}

/// Touches the stack that the loop may need, so that no page is missing later.
void prefault_stack() noexcept {
  volatile unsigned char pages[256 * 1024];
  for (std::size_t i = 0; i < sizeof pages; i += 1024) pages[i] = 0;
}

void add_lack(std::string& lacks, const std::string& sentence) {
  if (!lacks.empty()) lacks += "; ";
  lacks += sentence;
}

}  // namespace

RealtimeThread::RealtimeThread(const Parameters& parameters) : parameters_(parameters) {
  core::require(parameters.priority >= 0 && parameters.priority <= 99, "priority",
                "a number in [0, 99]", parameters.priority);
  core::require(parameters.cpu >= -1 && parameters.cpu < CPU_SETSIZE, "cpu",
                "the number of a CPU, or -1", parameters.cpu);
  core::require(parameters.spin_s >= 0.0 && std::isfinite(parameters.spin_s), "spin_s",
                "a finite number >= 0", parameters.spin_s);
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
  if (report_.memory_locked) munlockall();
}

void RealtimeThread::prepare() noexcept {
  report_.scheduler = "SCHED_OTHER";
  if (parameters_.priority > 0) {
    sched_param priority{};
    priority.sched_priority = parameters_.priority;
    const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &priority);
    if (error == 0) {
      report_.realtime_scheduler = true;
      report_.scheduler = "SCHED_FIFO " + std::to_string(parameters_.priority);
    } else {
      add_lack(report_.lacks, "the real-time scheduler was refused (" +
                                  std::string(std::strerror(error)) +
                                  "): allow rtprio in /etc/security/limits.d");
    }
  }
  if (parameters_.lock_memory) {
    report_.memory_locked = mlockall(MCL_CURRENT | MCL_FUTURE) == 0;
    if (!report_.memory_locked) {
      add_lack(report_.lacks, "memory could not be locked (" +
                                  std::string(std::strerror(errno)) +
                                  "): allow memlock in /etc/security/limits.d");
    }
  }
  if (parameters_.cpu >= 0) {
    cpu_set_t cpus;
    CPU_ZERO(&cpus);
    CPU_SET(parameters_.cpu, &cpus);
    const int error = pthread_setaffinity_np(pthread_self(), sizeof cpus, &cpus);
    report_.pinned = error == 0;
    if (!report_.pinned) {
      add_lack(report_.lacks, "CPU " + std::to_string(parameters_.cpu) + " could not be had (" +
                                  std::strerror(error) + ")");
    }
  }
  prefault_stack();
}

void RealtimeThread::run() noexcept {
  const std::int64_t period_ns =
      std::max<std::int64_t>(1, std::llround(1e9 * loop_->period_s()));
  const std::int64_t spin_ns = std::llround(1e9 * parameters_.spin_s);
  std::int64_t due_ns = monotonic_ns() + period_ns;
  while (!stop_.load(std::memory_order_relaxed)) {
    if (due_ns - spin_ns > monotonic_ns()) sleep_until(due_ns - spin_ns);
    std::int64_t started_ns = monotonic_ns();
    while (started_ns < due_ns) started_ns = monotonic_ns();

    loop_->render();
    const std::int64_t written_ns = monotonic_ns();
    loop_->report();
    const std::int64_t ended_ns = monotonic_ns();
    timing_.record_tick(written_ns - due_ns, ended_ns - started_ns);

    due_ns += period_ns;
    if (ended_ns >= due_ns + period_ns) {
      const std::int64_t num_missed = (ended_ns - due_ns) / period_ns;
      timing_.record_missed(num_missed);
      due_ns += num_missed * period_ns;
    }
  }
}

void require_realtime(const HapticDevice& device, const RealtimeReport& report,
                      bool allow_no_realtime) {
  if (device.capabilities().simulated || allow_no_realtime) return;
  if (report.realtime_scheduler && report.memory_locked) return;
  throw core::Error(std::string(device.name()) +
                    ": expected a real-time scheduler and locked memory before its motors turn "
                    "on, found " +
                    report.scheduler +
                    (report.memory_locked ? ", memory locked" : ", memory not locked") +
                    "; allow it with --allow-no-realtime, which is stored with the session");
}

}  // namespace jnd::device
