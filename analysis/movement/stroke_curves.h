#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/hand.h"
#include "core/joints.h"

namespace jnd::analysis {

/// A quantity over a stroke: mean and spread (sd with n - 1) over strokes, one value a point of
/// `StrokeCurves::stroke_percent`. Empty where there is no stroke; the spread also of one
/// alone.
struct CurveBand {
  std::vector<double> mean;
  std::vector<double> standard_deviation;
};

/// Whole strokes laid over one another, from 0 to 100 % of the time from the middle of the
/// motion back, over the turning point, forward, over the other turning point and back to the
/// middle again (thesis, fig. D.18, D.19, D.26 to D.28).
struct StrokeCurves {
  int num_strokes = 0;
  /// Of them, single strokes whose end, at most a fifth of their width away, was joined to
  /// their beginning: where a presentation holds no motion back before and after the one
  /// forward.
  int num_joined = 0;
  std::vector<double> stroke_percent;  ///< 0, 1 ... 100; empty without a stroke.
  /// Where the hand turned forward, and where back again; means over strokes.
  std::optional<double> turn_forward_percent, turn_back_percent;
  CurveBand
      forward_velocity_m_per_s;  ///< Of the hand along `forward`; negative on its way back.
  CurveBand height_m;            ///< Height of the hand, workspace frame.
  CurveBand opposing_force_n;    ///< Rendered, after every limit, against the hand's motion.
  /// From each point's tip to the end effector, in the order of `core::ContactPoint`.
  std::array<CurveBand, core::kNumContactPoints> tip_distance_m;
  bool has_joints = false;  ///< Without joints the joints' bands are empty.
  /// In the order of `core::kJointNames`; the distal joint of a finger follows its proximal.
  std::array<CurveBand, core::kNumJoints> joint_position_rad;
  std::array<CurveBand, core::kNumJoints>
      joint_torque_n_m;  ///< Torques that the sensors measured.
};

}  // namespace jnd::analysis
