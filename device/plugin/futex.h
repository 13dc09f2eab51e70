#pragma once

#include <atomic>
#include <cstdint>

namespace jnd::device {

/// CLOCK_MONOTONIC, which all processes of a machine share. Real time.
[[nodiscard]] std::int64_t monotonic_ns() noexcept;

/// Waits until the word is no longer `seen`, somebody wakes it up, a signal comes, or this
/// monotonic time is over, whichever is first. The word may lie in memory that two processes
/// share, and that this one may only read. Real time but for the waiting.
void futex_wait_until(const std::atomic<std::uint32_t>& word, std::uint32_t seen,
                      std::int64_t deadline_ns) noexcept;

/// The same, but looks at the word again and again without sleeping: to be woken up takes
/// longer than most answers do. Real time, for as long as it looks.
void look_until(const std::atomic<std::uint32_t>& word, std::uint32_t seen,
                std::int64_t deadline_ns) noexcept;

/// Everybody who waits for it. Real time; a system call.
void futex_wake(const std::atomic<std::uint32_t>& word) noexcept;

}  // namespace jnd::device
