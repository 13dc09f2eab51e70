#pragma once

#include <algorithm>
#include <atomic>

#include "core/hand.h"

namespace jnd::device {

/// Keeps the promise of `HapticDevice::halt` for a device that computes its forces here: after
/// `halt` there is no force until a write consists of zeros only. Real time.
class HaltLatch {
 public:
  /// Any thread may call it.
  void halt() noexcept { halted_.store(true, std::memory_order_release); }
  /// Any thread may call it.
  [[nodiscard]] bool is_halted() const noexcept {
    return halted_.load(std::memory_order_acquire);
  }
  /// Call it when the device is opened again.
  void reset() noexcept { halted_.store(false, std::memory_order_relaxed); }

  /// Whether this write must not give its force. Only zeros end a halt, because a loop that was
  /// held up in the middle of a tick must not bring its old force back. For the loop's thread.
  [[nodiscard]] bool withholds(const core::PointVectors& asked_n) noexcept {
    const bool nothing_asked =
        std::all_of(asked_n.begin(), asked_n.end(),
                    [](const Eigen::Vector3d& force_n) { return force_n.isZero(0.0); });
    return nothing_asked ? halted_.exchange(false, std::memory_order_acq_rel) : is_halted();
  }

 private:
  std::atomic<bool> halted_{false};
};

}  // namespace jnd::device
