#pragma once

#include <Eigen/Core>

#include "core/hand.h"

namespace jnd::core {

/// Sees a device that says it tells of its force and never does: the watch over energy would be
/// blind. So is one that withholds what it is sent. Real time.
class UnseenForce {
 public:
  /// `sent_n`: asked for last; `acted_n`: as the device tells; both on the hand, at the points,
  /// over `duration_s`. True: 0.5 N and more were sent for half a second in all, and none acted
  /// since. How late a force may act is far below that.
  [[nodiscard]] bool observe(const PointVectors& sent_n, const PointVectors& acted_n,
                             double duration_s) noexcept {
    double sent_sum_n = 0.0;
    bool any_acted = false;
    for (int i = 0; i < kNumContactPoints; ++i) {
      sent_sum_n += sent_n[i].norm();
      any_acted |= !acted_n[i].isZero(0.0);
    }
    if (any_acted) {
      unseen_s_ = 0.0;
    } else if (sent_sum_n >= kClear_n) {
      unseen_s_ += duration_s;
    }
    return unseen_s_ > kLongest_s;
  }

  void reset() noexcept { unseen_s_ = 0.0; }

 private:
  static constexpr double kClear_n = 0.5, kLongest_s = 0.5;

  double unseen_s_ = 0.0;
};

}  // namespace jnd::core
