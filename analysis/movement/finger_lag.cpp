#include "analysis/movement/finger_lag.h"

#include <cmath>
#include <utility>

namespace jnd::analysis {

void FingerLag::feed(const Eigen::Vector3d& fingers_m, const Eigen::Vector3d& palm_m,
                     const Eigen::Vector3d& palm_velocity_m_per_s) noexcept {
  const Eigen::Vector2d velocity = palm_velocity_m_per_s.head<2>();
  Eigen::Vector2d displacement = (fingers_m - palm_m).head<2>();
  if (!std::isfinite(displacement.sum() + velocity.sum())) return;
  if (sums_.num_ticks == 0.0) sums_.first_m = displacement;
  displacement -= sums_.first_m;
  sums_.num_ticks += 1.0;
  sums_.displacement_m += displacement;
  sums_.velocity_m_per_s += velocity;
  sums_.displacement_squared_m2 += displacement.squaredNorm();
  sums_.velocity_squared_m2_per_s2 += velocity.squaredNorm();
  sums_.product_m2_per_s += displacement.dot(velocity);
}

std::optional<double> FingerLag::finish() noexcept {
  constexpr double kRest_m_per_s = 1e-3;
  constexpr double kTogether_m = 1e-6;
  const Sums sums = std::exchange(sums_, {});
  if (sums.num_ticks < 2.0) return std::nullopt;
  const Eigen::Vector2d displacement = sums.displacement_m / sums.num_ticks;
  const Eigen::Vector2d velocity = sums.velocity_m_per_s / sums.num_ticks;
  const double spread =
      sums.displacement_squared_m2 / sums.num_ticks - displacement.squaredNorm();
  const double speed_squared =
      sums.velocity_squared_m2_per_s2 / sums.num_ticks - velocity.squaredNorm();
  if (!(spread > kTogether_m * kTogether_m)) return std::nullopt;
  if (!(speed_squared > kRest_m_per_s * kRest_m_per_s)) return std::nullopt;
  return -(sums.product_m2_per_s / sums.num_ticks - displacement.dot(velocity)) / speed_squared;
}

}  // namespace jnd::analysis
