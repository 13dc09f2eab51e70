#include "device/watchdog.h"

#include <cmath>
#include <ctime>

#include "core/clock.h"
#include "core/require.h"

namespace jnd::device {
namespace {

using core::kNsPerS;
constexpr double kLooksPerTimeout = 10.0;

std::int64_t timeout_ns_of(const Watchdog::Parameters& parameters) {
  core::require(parameters.timeout_s > 0.0 && parameters.timeout_s <= 10.0, "timeout_s",
                "a number in (0, 10]", parameters.timeout_s);
  return std::llround(1e9 * parameters.timeout_s);
}

int checked_priority(int priority) {
  core::require(priority >= 0 && priority <= 99, "priority", "a number in [0, 99]", priority);
  return priority;
}

}  // namespace

Watchdog::Watchdog(const Parameters& parameters, HapticDevice& device,
                   core::WatchdogState& state)
    : timeout_ns_(timeout_ns_of(parameters)), device_(device), state_(state) {}

void Watchdog::look(std::int64_t now_ns) noexcept {
  const std::uint64_t beats = state_.num_beats();
  if (beats == 0) return;
  if (beats != last_beats_) {
    last_beats_ = beats;
    silent_since_ns_ = now_ns;
  }
  if (now_ns - silent_since_ns_ < timeout_ns_) return;
  silent_since_ns_ = now_ns;
  // First the state is set, so that a loop that wakes up in between does not overwrite the
  // halt.
  state_.bite();
  device_.halt();
}

WatchdogThread::WatchdogThread(const Parameters& parameters, HapticDevice& device,
                               core::WatchdogState& state)
    : watchdog_(parameters.watchdog, device, state),
      period_ns_(std::llround(1e9 * parameters.watchdog.timeout_s / kLooksPerTimeout)),
      priority_(checked_priority(parameters.priority)),
      thread_([this] {
        obtain_scheduler(priority_, report_);
        prepared_.release();
        run();
      }) {
  prepared_.acquire();
}

WatchdogThread::~WatchdogThread() {
  stop_ = true;
  thread_.join();
}

void WatchdogThread::run() noexcept {
  timespec due{};
  clock_gettime(CLOCK_MONOTONIC, &due);
  while (!stop_.load(std::memory_order_relaxed)) {
    const std::int64_t next_ns = std::int64_t{due.tv_sec} * kNsPerS + due.tv_nsec + period_ns_;
    due = {.tv_sec = static_cast<time_t>(next_ns / kNsPerS),
           .tv_nsec = static_cast<long>(next_ns % kNsPerS)};
    while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, nullptr) != 0) {
    }
    timespec now{};
    clock_gettime(CLOCK_MONOTONIC, &now);
    const std::int64_t now_ns = std::int64_t{now.tv_sec} * kNsPerS + now.tv_nsec;
    // If the whole machine was held up, missed looks are not made up for.
    if (now_ns - next_ns > period_ns_) due = now;
    watchdog_.look(now_ns);
  }
}

}  // namespace jnd::device
