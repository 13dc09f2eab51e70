#include "device/exoskeleton/torque_stages.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace jnd::device {

double LimitProtection::torque_n_m(double position_rad,
                                   double velocity_rad_per_s) const noexcept {
  const bool above = position_rad > high_rad;
  const double depth_rad = above ? position_rad - high_rad : low_rad - position_rad;
  if (!(depth_rad > 0.0)) return 0.0;
  const double outward = above ? 1.0 : -1.0;
  const double damping = damping_n_m_s_per_rad * std::min(1.0, depth_rad / kFullDepth_rad);
  const double inward_n_m =
      stiffness_n_m_per_rad * depth_rad + damping * outward * velocity_rad_per_s;
  return -outward * std::clamp(inward_n_m, 0.0, max_torque_n_m);
}

LimitProtection default_protection(int joint) {
  // The elbow has to stay up, because otherwise the arm, which has one joint more than a
  // platform needs, would turn.
  if (joint == 2) return {-0.35, 0.35, 10.0, 1.0, 10.0};
  if (joint < core::kNumArmJoints) {
    constexpr double kMargin_rad = 0.1;
    const JointRange range = range_of(joint);
    return {.low_rad = range.low_rad + kMargin_rad,
            .high_rad = range.high_rad - kMargin_rad,
            .stiffness_n_m_per_rad = 50.0,
            .damping_n_m_s_per_rad = 5.0,
            .max_torque_n_m = 20.0};
  }
  // A play of some 2 cm at the tip in each direction, then about 200 N/m, up to 5 N at a tip
  // that is 6 to 7 cm away. These are assumptions.
  constexpr double kMost_n_m = 0.35;
  switch ((joint - core::kNumArmJoints) % core::kNumJointsPerFinger) {
    case 0:
      return {-0.20, 0.20, 2.0, 0.05, kMost_n_m};
    case 1:
      return {kNeutralExtension_rad - 0.15, kNeutralExtension_rad + 0.15, 2.0, 0.05, kMost_n_m};
    default:
      return {kNeutralProximal_rad - 0.20, kNeutralProximal_rad + 0.20, 1.5, 0.02, kMost_n_m};
  }
}

double friction_compensation_n_m(double friction_n_m, double ratio, double velocity_rad_per_s,
                                 double smooth_speed_rad_per_s) noexcept {
  return ratio * friction_n_m * velocity_rad_per_s /
         std::sqrt(velocity_rad_per_s * velocity_rad_per_s +
                   smooth_speed_rad_per_s * smooth_speed_rad_per_s);
}

JointVector max_torque_n_m() {
  constexpr std::array<double, core::kNumArmJoints> kArm_n_m = {176.0, 176.0, 100.0, 100.0,
                                                                100.0, 38.0,  38.0};
  constexpr std::array<double, core::kNumJointsPerFinger> kFinger_n_m = {1.5, 1.5, 1.2};
  JointVector max_n_m;
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    max_n_m[joint] =
        joint < core::kNumArmJoints
            ? kArm_n_m[joint]
            : kFinger_n_m[(joint - core::kNumArmJoints) % core::kNumJointsPerFinger];
  }
  return max_n_m;
}

}  // namespace jnd::device
