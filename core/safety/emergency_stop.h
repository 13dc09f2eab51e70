#pragma once

#include <atomic>
#include <cstdint>

namespace jnd::core {

/// For so long after the stop was released nobody can arm, lest two clicks that were meant as
/// one release it and bring the force back. Windows takes two clicks within 0.5 s for a double
/// click (`GetDoubleClickTime`), and GTK 4 within 0.4 s (`gtk-double-click-time`).
inline constexpr double kArmAfterRelease_s = 0.5;

/// The emergency stop: pressed from any thread, latched, read first in every tick. Not a
/// command, so that nothing newer can overtake it. Releasing it is an act of its own and does
/// not bring the force back: the loop has to be armed again, too. Real time.
class EmergencyStop {
 public:
  void press() noexcept {
    std::uint64_t state = state_.load(std::memory_order_relaxed);
    while (!state_.compare_exchange_weak(state, ((state | 1) + 2), std::memory_order_acq_rel)) {
    }
  }
  /// Releases the stop unless somebody has pressed it since `num_presses` was read, so that a
  /// release meant for an earlier press never undoes a later one. Returns whether it is
  /// released.
  bool release(std::uint64_t num_presses) noexcept {
    std::uint64_t pressed = num_presses << 1 | 1;
    return state_.compare_exchange_strong(pressed, num_presses << 1,
                                          std::memory_order_acq_rel) ||
           !is_pressed();
  }
  [[nodiscard]] bool is_pressed() const noexcept {
    return (state_.load(std::memory_order_acquire) & 1) != 0;
  }
  /// Returns how often the stop has been pressed.
  [[nodiscard]] std::uint64_t num_presses() const noexcept {
    return state_.load(std::memory_order_acquire) >> 1;
  }

 private:
  std::atomic<std::uint64_t> state_{0};  ///< Twice the number of presses, and 1 while pressed.
  static_assert(std::atomic<std::uint64_t>::is_always_lock_free);
};

}  // namespace jnd::core
