#include "device/sleep_watch.h"

#include <algorithm>
#include <ctime>

#include "core/clock.h"

namespace jnd::device {
namespace {

std::int64_t sleepless_ns(clockid_t clock) noexcept {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<std::int64_t>(now.tv_sec) * core::kNsPerS + now.tv_nsec;
}

std::int64_t system_boottime_ns() noexcept { return sleepless_ns(CLOCK_BOOTTIME); }

}  // namespace

SleepWatch::SleepWatch(std::int64_t (*boottime_ns)() noexcept) noexcept
    : boottime_ns_(boottime_ns != nullptr ? boottime_ns : system_boottime_ns),
      known_ns_(slept_ns()) {}

/// Since the machine was started, at the least: the monotonic clock is read last, so that being
/// held up in between makes it less.
std::int64_t SleepWatch::slept_ns() const noexcept {
  const std::int64_t boottime_ns = boottime_ns_();
  return boottime_ns - sleepless_ns(CLOCK_MONOTONIC);
}

bool SleepWatch::has_slept() noexcept {
  constexpr std::int64_t kSleepNs = 1'000'000;  // Far above what two readings are apart.
  const std::int64_t now_ns = slept_ns();
  const bool has_slept = now_ns - known_ns_ > kSleepNs;
  known_ns_ = std::max(known_ns_, now_ns);
  return has_slept;
}

}  // namespace jnd::device
