#pragma once

#include <Eigen/Core>

#include "core/hand.h"

namespace jnd::core {

/// Detects a device that claims to report its force but never does, or that withholds the force
/// it is sent. The guard of energy would be blind to it. Real time.
class UnseenForce {
 public:
  /// `sent_n` are the forces sent last, and `acted_n` those that the device reports, both on
  /// the hand at the points, over `duration_s`. Returns true once 0.5 N or more were sent for
  /// half a second in total and no force has acted since. A force may act late by far less than
  /// that.
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
