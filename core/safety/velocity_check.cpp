#include "core/safety/velocity_check.h"

#include <algorithm>
#include <cmath>

#include "core/require.h"

namespace jnd::core {

VelocityCheck::VelocityCheck(const Parameters& parameters) : parameters_(parameters) {
  require_positive(parameters.max_error_m, "max_error_m");
  require_positive(parameters.max_error_ratio, "max_error_ratio");
  require_positive(parameters.memory_s, "memory_s");
}

void VelocityCheck::observe(const PointVectors& tip_position_m,
                            const PointVectors& tip_velocity_m_per_s,
                            const std::array<bool, kNumContactPoints>& attached,
                            double elapsed_s) noexcept {
  const double kept_ratio = std::max(0.0, 1.0 - elapsed_s / parameters_.memory_s);
  is_near_ = false;
  for (int i = 0; i < kNumContactPoints; ++i) {
    if (!attached[i]) {
      error_m_[i].setZero();
      way_m_[i] = 0.0;
      continue;
    }
    if (!has_last_ || !was_held_[i]) continue;
    const Eigen::Vector3d moved_m = tip_position_m[i] - last_position_m_[i];
    error_m_[i] = kept_ratio * error_m_[i] + elapsed_s * tip_velocity_m_per_s[i] - moved_m;
    way_m_[i] = kept_ratio * way_m_[i] + moved_m.lpNorm<1>();
    const double error_m = error_m_[i].lpNorm<1>();
    const double max_error_m =
        std::max(parameters_.max_error_m, parameters_.max_error_ratio * way_m_[i]);
    is_contradicted_ |= error_m > max_error_m;
    is_near_ |= error_m > 0.5 * max_error_m;
  }
  last_position_m_ = tip_position_m;
  was_held_ = attached;
  has_last_ = true;
}

void VelocityCheck::reset() noexcept {
  has_last_ = false;
  is_contradicted_ = false;
  is_near_ = false;
  error_m_ = zero_vectors();
  way_m_.fill(0.0);
}

}  // namespace jnd::core
