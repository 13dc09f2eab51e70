#include "core/safety/force_limiter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/require.h"

namespace jnd::core {
namespace {

/// Also false for a vector so long that its square overflows, which no hand should feel.
bool is_finite(const Eigen::Vector3d& vector) noexcept {
  return vector.squaredNorm() <= std::numeric_limits<double>::max();
}

}  // namespace

ForceLimiter::ForceLimiter(const Parameters& parameters, double period_s)
    : parameters_(parameters), max_step_n_(parameters.slew_n_per_s * period_s) {
  require_positive(parameters.per_point_n, "per_point_n");
  require_positive(parameters.total_n, "total_n");
  require_positive(parameters.slew_n_per_s, "slew_n_per_s");
  require_positive(parameters.max_speed_m_per_s, "max_speed_m_per_s");
  require_positive(period_s, "period_s");
}

Fault ForceLimiter::found_fault(const std::array<bool, kNumContactPoints>& attached,
                                const PointVectors& tip_velocity_m_per_s,
                                const PointVectors& force_on_hand_n) const noexcept {
  const double max_squared = parameters_.max_speed_m_per_s * parameters_.max_speed_m_per_s;
  for (int i = 0; i < kNumContactPoints; ++i) {
    if (!is_finite(force_on_hand_n[i])) return Fault::kNonFiniteForce;
    const double speed_squared = tip_velocity_m_per_s[i].squaredNorm();
    if (std::isnan(speed_squared)) return Fault::kNonFiniteState;
    if (attached[i] && !(speed_squared <= max_squared)) return Fault::kOverVelocity;
  }
  return Fault::kNone;
}

bool ForceLimiter::limit(const std::array<bool, kNumContactPoints>& attached,
                         const PointVectors& tip_velocity_m_per_s,
                         PointVectors& force_on_hand_n) noexcept {
  if (fault_ == Fault::kNone) {
    fault_ = found_fault(attached, tip_velocity_m_per_s, force_on_hand_n);
  }
  if (fault_ != Fault::kNone) {
    bool changed = false;
    for (Eigen::Vector3d& force : force_on_hand_n) {
      if (!(force.squaredNorm() == 0.0)) changed = true;
      force.setZero();
    }
    last_n_ = zero_vectors();
    return changed;
  }

  bool changed = false;
  double sum_n = 0.0;
  for (int i = 0; i < kNumContactPoints; ++i) {
    Eigen::Vector3d& force = force_on_hand_n[i];
    if (!attached[i]) {
      if (force.squaredNorm() != 0.0) changed = true;
      force.setZero();
      last_n_[i].setZero();
      continue;
    }
    double magnitude_n = std::sqrt(force.squaredNorm());
    if (magnitude_n > parameters_.per_point_n) {
      force *= parameters_.per_point_n / magnitude_n;
      magnitude_n = parameters_.per_point_n;
      changed = true;
    }
    sum_n += magnitude_n;
  }
  if (sum_n > parameters_.total_n) {
    const double scale = parameters_.total_n / sum_n;
    for (Eigen::Vector3d& force : force_on_hand_n) force *= scale;
    changed = true;
  }

  // All points move by the same share of their step. The bounds above are convex, so any point
  // on the line between two sets of forces that keep them keeps them, too.
  double max_squared_step = 0.0;
  for (int i = 0; i < kNumContactPoints; ++i) {
    max_squared_step =
        std::max(max_squared_step, (force_on_hand_n[i] - last_n_[i]).squaredNorm());
  }
  if (max_squared_step > max_step_n_ * max_step_n_) {
    const double ratio = max_step_n_ / std::sqrt(max_squared_step);
    for (int i = 0; i < kNumContactPoints; ++i) {
      force_on_hand_n[i] = last_n_[i] + ratio * (force_on_hand_n[i] - last_n_[i]);
    }
    changed = true;
  }
  last_n_ = force_on_hand_n;
  return changed;
}

void ForceLimiter::rearm() noexcept {
  fault_ = Fault::kNone;
  last_n_ = zero_vectors();
}

}  // namespace jnd::core
