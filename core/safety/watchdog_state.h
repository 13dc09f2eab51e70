#pragma once

#include <atomic>
#include <cstdint>

namespace jnd::core {

/// What a haptic loop and the watchdog beside it know of each other. The loop beats once a tick
/// and checks whether the watchdog has bitten. The watchdog counts the beats, and bites if they
/// stop. Real time.
class WatchdogState {
 public:
  // For the loop.

  void beat() noexcept { num_beats_.fetch_add(1, std::memory_order_relaxed); }
  /// Whether the watchdog has taken the force away since `forgive`.
  [[nodiscard]] bool has_bitten() const noexcept {
    return bitten_.load(std::memory_order_acquire);
  }
  /// The loop calls it when it is armed again.
  void forgive() noexcept { bitten_.store(false, std::memory_order_release); }

  // For the watchdog.

  [[nodiscard]] std::uint64_t num_beats() const noexcept {
    return num_beats_.load(std::memory_order_relaxed);
  }
  void bite() noexcept {
    num_bites_.fetch_add(1, std::memory_order_relaxed);
    bitten_.store(true, std::memory_order_release);
  }
  [[nodiscard]] std::uint64_t num_bites() const noexcept {
    return num_bites_.load(std::memory_order_relaxed);
  }

 private:
  std::atomic<std::uint64_t> num_beats_{0};
  std::atomic<std::uint64_t> num_bites_{0};
  std::atomic<bool> bitten_{false};
};

}  // namespace jnd::core
