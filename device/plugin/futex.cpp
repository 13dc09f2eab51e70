#include "device/plugin/futex.h"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <climits>
#include <ctime>

#include "core/clock.h"

namespace jnd::device {

static_assert(sizeof(std::atomic<std::uint32_t>) == sizeof(std::uint32_t) &&
              std::atomic<std::uint32_t>::is_always_lock_free &&
              std::atomic<std::uint64_t>::is_always_lock_free);

std::int64_t monotonic_ns() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * core::kNsPerS + now.tv_nsec;
}

void futex_wait_until(const std::atomic<std::uint32_t>& word, std::uint32_t seen,
                      std::int64_t deadline_ns) noexcept {
  const timespec deadline{.tv_sec = static_cast<time_t>(deadline_ns / core::kNsPerS),
                          .tv_nsec = static_cast<long>(deadline_ns % core::kNsPerS)};
  // Of the futex calls, only this one takes an absolute time.
  ::syscall(SYS_futex, &word, FUTEX_WAIT_BITSET, seen, &deadline, nullptr,
            FUTEX_BITSET_MATCH_ANY);
}

void look_until(const std::atomic<std::uint32_t>& word, std::uint32_t seen,
                std::int64_t deadline_ns) noexcept {
  while (word.load(std::memory_order_acquire) == seen && monotonic_ns() < deadline_ns) {
  }
}

void futex_wake(const std::atomic<std::uint32_t>& word) noexcept {
  ::syscall(SYS_futex, &word, FUTEX_WAKE, INT_MAX, nullptr, nullptr, 0);
}

}  // namespace jnd::device
