#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

#include "core/sample.h"

namespace jnd::analysis {

/// Returns a sample of a recording at 1 kHz that the formulas of data/reference/movement make:
/// strokes along (0.8, 0.6) with a tremor, and 0.4 s of rest in the middle of one.
inline core::Sample made_up_sample(std::int64_t tick) {
  constexpr double kPi = std::numbers::pi;
  const double t = static_cast<double>(tick) * 0.001;
  const bool rests = t >= 4.3 && t < 4.7;
  const double moving = t < 4.3 ? t : (t < 4.7 ? 4.3 : t - 0.4);
  const double phase = 2.0 * kPi * (0.55 * moving + 0.02 * std::sin(0.9 * moving));
  const double way = (0.16 + 0.03 * std::sin(0.7 * moving)) * std::sin(phase) +
                     0.002 * std::sin(2.0 * kPi * 8.0 * t);
  const core::PlainVector hand = {0.8 * way + 0.05, 0.6 * way - 0.02,
                                  -0.15 + 0.01 * std::cos(phase)};
  const double along = rests ? 0.0 : 0.9 * std::cos(phase) + 0.05;
  const core::PlainVector velocity = {0.8 * along, 0.6 * along,
                                      rests ? 0.0 : 0.02 * std::sin(3.0 * t)};
  core::Sample sample{.tick = tick, .attached_bits = 31, .immersed_bits = 31};
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    const double place = point - 2.0;
    const core::PlainVector offset = {0.01 * place, 0.0, -0.005 * place};
    for (int axis = 0; axis < 3; ++axis) {
      sample.tip_position_m[point][axis] = hand[axis] + offset[axis];
      sample.tip_velocity_m_per_s[point][axis] = velocity[axis] * (1.0 + 0.01 * place);
      sample.tip_force_n[point][axis] =
          -(3.0 + 0.2 * point) * velocity[axis] * (1.0 + 0.01 * place) +
          (axis == 2 ? 0.1 : 0.0);
    }
  }
  sample.end_effector_position_m = {hand[0] - 0.135 + 0.01 * std::sin(phase), hand[1] + 0.02,
                                    hand[2]};
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    sample.joint_position_rad[joint] =
        static_cast<float>(0.1 * joint + 0.2 * std::sin(phase + 0.1 * joint));
    sample.joint_torque_n_m[joint] = static_cast<float>(0.05 * joint * std::cos(phase));
  }
  return sample;
}

}  // namespace jnd::analysis
