#pragma once

#include <atomic>

namespace jnd::core {

/// The emergency stop: pressed from any thread, latched, read first in every tick. Not a
/// command, so that nothing newer can overtake it. Releasing it is an act of its own and does
/// not bring the force back: the loop has to be armed again, too. Real time.
class EmergencyStop {
 public:
  void press() noexcept { pressed_.store(true, std::memory_order_release); }
  void release() noexcept { pressed_.store(false, std::memory_order_release); }
  [[nodiscard]] bool is_pressed() const noexcept {
    return pressed_.load(std::memory_order_acquire);
  }

 private:
  std::atomic<bool> pressed_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

}  // namespace jnd::core
