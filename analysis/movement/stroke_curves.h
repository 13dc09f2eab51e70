#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/hand.h"
#include "core/joints.h"

namespace jnd::analysis {

/// A quantity over a stroke: mean and standard deviation (n - 1) over strokes, with one value
/// for each point of `StrokeCurves::stroke_percent`. Both are empty without a stroke; the
/// standard deviation is also empty for a single one.
struct CurveBand {
  std::vector<double> mean;
  std::vector<double> standard_deviation;
};

/// Whole strokes superimposed, from 0 to 100 % of the time. A stroke starts in the middle of
/// the motion back, passes the turning point, moves forward, passes the other turning point,
/// and moves back to the middle (thesis, fig. D.18, D.19, D.26 to D.28).
struct StrokeCurves {
  int num_strokes = 0;
  /// The number of single strokes whose end was joined to their beginning, from which it was at
  /// most a fifth of the width away. They are used if a presentation has no motion back both
  /// before and after a forward motion.
  int num_joined = 0;
  std::vector<double> stroke_percent;  ///< 0, 1 ... 100; empty without a stroke.
  /// Where the hand turned forward and where it turned back, as means over strokes.
  std::optional<double> turn_forward_percent, turn_back_percent;
  CurveBand
      /// The velocity of the hand along `forward`; negative on the way back.
      forward_velocity_m_per_s;
  CurveBand height_m;  ///< The height of the hand in the workspace frame.
  /// The rendered force against the hand's motion, after every limit.
  CurveBand opposing_force_n;
  /// The distance of each point's tip from the end effector, in the order of
  /// `core::ContactPoint`.
  std::array<CurveBand, core::kNumContactPoints> tip_distance_m;
  /// Whether there are joints. Without them the joints' bands are empty.
  bool has_joints = false;
  /// In the order of `core::kJointNames`. The distal joint of a finger follows the proximal
  /// one.
  std::array<CurveBand, core::kNumJoints> joint_position_rad;
  std::array<CurveBand, core::kNumJoints>
      joint_torque_n_m;  ///< The torques that the sensors measured.
};

}  // namespace jnd::analysis
