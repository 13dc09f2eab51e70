#pragma once

#include <atomic>
#include <cstdint>

namespace jnd::device {

/// Returns the time by CLOCK_MONOTONIC, which all processes of a machine share. Real time.
[[nodiscard]] std::int64_t monotonic_ns() noexcept;

/// Waits until the word is no longer `seen`, somebody wakes it, a signal comes, or this
/// monotonic time has passed. The word may be in memory that two processes share and that this
/// one may only read. Real time apart from the waiting.
void futex_wait_until(const std::atomic<std::uint32_t>& word, std::uint32_t seen,
                      std::int64_t deadline_ns) noexcept;

/// Does the same but spins on the word without sleeping, because waking takes longer than most
/// answers. Real time for as long as it spins.
void look_until(const std::atomic<std::uint32_t>& word, std::uint32_t seen,
                std::int64_t deadline_ns) noexcept;

/// Wakes everybody who waits for the word. Real time; a system call.
void futex_wake(const std::atomic<std::uint32_t>& word) noexcept;

}  // namespace jnd::device
