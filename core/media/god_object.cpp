#include "core/media/god_object.h"

#include <algorithm>
#include <cmath>

#include "core/require.h"

namespace jnd::core {
namespace {

Eigen::Vector3d along_surface(const Eigen::Vector3d& vector,
                              const Eigen::Vector3d& normal) noexcept {
  return vector - vector.dot(normal) * normal;
}

double faded_damping_n_s_per_m(const SolidAmounts& amounts, double felt_depth_m) noexcept {
  return amounts.damping_n_s_per_m *
         std::min(1.0, felt_depth_m / GodObject::kFullDampingDepthM);
}

}  // namespace

SolidAmounts solid_amounts(const SolidParameters& parameters) {
  require_not_negative(parameters.stiffness_n_per_m, "stiffness_n_per_m");
  require_not_negative(parameters.damping_n_s_per_m, "damping_n_s_per_m");
  require_not_negative(parameters.friction_ratio, "friction_ratio");
  const double friction_n_per_m = parameters.friction_ratio * parameters.stiffness_n_per_m;
  require_not_negative(friction_n_per_m, "friction_ratio");
  return {parameters.stiffness_n_per_m, parameters.damping_n_s_per_m, friction_n_per_m};
}

Eigen::Vector3d GodObject::force_n(const SolidAmounts& amounts, const Eigen::Vector3d& normal,
                                   double depth_m, const Eigen::Vector3d& position_m,
                                   const Eigen::Vector3d& velocity_m_per_s,
                                   double period_s) noexcept {
  const double inside_m = depth_m > 0.0 ? depth_m : 0.0;
  if (is_known_) {
    // While a point leaves the solid, its surface never lies deeper than the point itself.
    sunk_m_ = std::clamp(sunk_m_ - kRiseMPerS * period_s, 0.0, inside_m);
  } else {
    is_known_ = true;
    sunk_m_ = inside_m;
  }
  const double felt_depth_m = inside_m - sunk_m_;
  if (!(felt_depth_m > 0.0)) {
    god_object_m_ = position_m;
    return Eigen::Vector3d::Zero();
  }
  const double normal_n =
      amounts.stiffness_n_per_m * felt_depth_m -
      faded_damping_n_s_per_m(amounts, felt_depth_m) * velocity_m_per_s.dot(normal);
  // std::max would hide a force that is not a number, which has to reach the limiter.
  Eigen::Vector3d force_n = (normal_n < 0.0 ? 0.0 : normal_n) * normal;
  if (amounts.friction_n_per_m != 0.0 && amounts.stiffness_n_per_m != 0.0) {
    force_n +=
        friction_n(amounts, normal, felt_depth_m, normal_n, position_m, velocity_m_per_s);
  }
  return force_n;
}

Eigen::Vector3d GodObject::friction_n(const SolidAmounts& amounts,
                                      const Eigen::Vector3d& normal, double felt_depth_m,
                                      double normal_n, const Eigen::Vector3d& position_m,
                                      const Eigen::Vector3d& velocity_m_per_s) noexcept {
  // The ratio is that of the amounts in force now, which a ramp may be changing.
  const double ratio = amounts.friction_n_per_m / amounts.stiffness_n_per_m;
  const double reach_m = ratio * felt_depth_m;
  Eigen::Vector3d offset_m = along_surface(god_object_m_ - position_m, normal);
  const double offset = offset_m.norm();
  if (!(offset <= reach_m)) offset_m *= reach_m / offset;
  god_object_m_ = position_m + offset_m;
  Eigen::Vector3d friction_n =
      amounts.stiffness_n_per_m * offset_m -
      faded_damping_n_s_per_m(amounts, felt_depth_m) * along_surface(velocity_m_per_s, normal);
  const double most_n = ratio * (normal_n < 0.0 ? 0.0 : normal_n);
  const double wanted_n = friction_n.norm();
  if (!(wanted_n <= most_n)) friction_n *= most_n / wanted_n;
  return friction_n;
}

}  // namespace jnd::core
