#pragma once

#include <Eigen/Core>
#include <algorithm>

#include "core/hand.h"

namespace jnd::core {

/// Detects a device that claims to report its force but never does, that withholds the force it
/// is sent, or that reports far more than it can give, as one of another unit does. The guard
/// of energy would be blind to it, or see what is not. Real time.
class UnseenForce {
 public:
  /// `most_n` is the most force that the device gives at a point, in N; infinity: not known.
  explicit UnseenForce(double most_n) noexcept
      : beyond_n_(std::max(kBeyond_ratio * most_n, kLeastBeyond_n)) {}

  /// `sent_n` are the forces sent last, and `acted_n` those that the device reports, both on
  /// the hand at the points, over `duration_s`. Returns true once 0.5 N or more were sent for
  /// half a second in total and no force has acted since, or once the device has reported more
  /// than ten times its most, and than 100 N, for 50 ms without a break. A force may act late
  /// by far less than half a second, and a hand that presses on a sensor shows more than the
  /// device gives.
  [[nodiscard]] bool observe(const PointVectors& sent_n, const PointVectors& acted_n,
                             double duration_s) noexcept {
    double sent_sum_n = 0.0;
    bool any_acted = false, any_beyond = false;
    for (int i = 0; i < kNumContactPoints; ++i) {
      sent_sum_n += sent_n[i].norm();
      any_acted |= !acted_n[i].isZero(0.0);
      any_beyond |= !(acted_n[i].norm() <= beyond_n_);
    }
    beyond_s_ = any_beyond ? beyond_s_ + duration_s : 0.0;
    if (any_acted) {
      unseen_s_ = 0.0;
    } else if (sent_sum_n >= kClear_n) {
      unseen_s_ += duration_s;
    }
    return unseen_s_ > kLongest_s || beyond_s_ > kLongestBeyond_s;
  }

  void reset() noexcept { unseen_s_ = beyond_s_ = 0.0; }

 private:
  static constexpr double kClear_n = 0.5, kLongest_s = 0.5;
  static constexpr double kBeyond_ratio = 10.0, kLeastBeyond_n = 100.0;
  static constexpr double kLongestBeyond_s = 0.05;

  double beyond_n_;
  double unseen_s_ = 0.0, beyond_s_ = 0.0;
};

}  // namespace jnd::core
