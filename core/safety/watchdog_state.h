#pragma once

#include <atomic>
#include <cstdint>

namespace jnd::core {

/// What a haptic loop and the watchdog beside it know of each other. The loop beats once a tick
/// and looks whether it was bitten; the watchdog counts the beats and bites. Real time.
class WatchdogState {
 public:
  // The loop's.

  void beat() noexcept { num_beats_.fetch_add(1, std::memory_order_relaxed); }
  /// The watchdog has taken the force away since `forgive`.
  [[nodiscard]] bool has_bitten() const noexcept {
    return bitten_.load(std::memory_order_acquire);
  }
  /// When the loop is armed again.
  void forgive() noexcept { bitten_.store(false, std::memory_order_release); }

  // The watchdog's.

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
