#pragma once

#include <Eigen/Core>
#include <array>
#include <numbers>

#include "core/hand.h"
#include "core/joints.h"

namespace jnd::device {

/// The dimensions and masses of the exoskeleton on its arm, as its control knows them. The
/// simulated world (data/models/exoskeleton.xml) uses the same numbers, whose sources are in
/// data/models/README.md. Tests compare the two.
///
/// Frames: `base` is the arm's foot, with axes parallel to the workspace's. `platform` has its
/// origin at the arm's flange (the end effector) and in the neutral pose the workspace's axes.
/// Each finger has a frame at its base joint, with +x along the stretched finger and +z towards
/// the hand.

/// One value for each joint, in the order of `core::kJointNames`: rad, rad/s or N m.
using JointVector = Eigen::Matrix<double, core::kNumJoints, 1>;

/// Mass and centre of mass of a link, in the frame of the joint before it.
struct LinkMass {
  double mass_kg;
  std::array<double, 3> center_m;
};

// The arm, a KUKA LWR 4+. Each link extends along z from its joint to the next one.
enum class Axis { kZ, kY, kMinusY };
inline constexpr std::array<Axis, core::kNumArmJoints> kArmAxes = {
    Axis::kZ, Axis::kMinusY, Axis::kZ, Axis::kY, Axis::kZ, Axis::kMinusY, Axis::kZ};
/// Distance along z from the joint before (at first the foot) to this one. 0.102 + 0.2085 =
/// 0.3105 m to the shoulder, 0.4 m to the elbow, 0.39 m to the wrist. The seventh joint turns
/// the flange.
inline constexpr std::array<double, core::kNumArmJoints> kArmOffsets_m = {
    0.102, 0.2085, 0.1915, 0.2085, 0.1915, 0.1985, 0.078};
inline constexpr std::array<LinkMass, core::kNumArmJoints> kArmLinks = {
    LinkMass{2.303, {0.0, 0.0233, 0.1181}},  LinkMass{2.303, {0.0, -0.0327, 0.0737}},
    LinkMass{2.303, {0.0, -0.0233, 0.1182}}, LinkMass{2.303, {0.0, 0.0327, 0.0737}},
    LinkMass{1.601, {0.0, 0.0208, 0.0862}},  LinkMass{1.493, {0.0, -0.0045, -0.0030}},
    LinkMass{0.109, {0.0, 0.0, -0.0158}}};

// The platform with the bodies of five fingers, mounted flat on the flange.
inline constexpr LinkMass kPlatform = {1.5, {0.04, 0.0, 0.01}};

// A finger of the DLR/HIT Hand II.
inline constexpr double kProximalLink_m = 0.055;
inline constexpr double kMedialLink_m = 0.025;
/// Includes the metal cone that holds the magnet.
inline constexpr double kDistalLink_m = 0.035;
/// Proximal, medial and distal link; the centres are along the link.
inline constexpr std::array<LinkMass, 3> kFingerLinks = {LinkMass{0.0444, {0.0275, 0.0, 0.0}},
                                                         LinkMass{0.0271, {0.0125, 0.0, 0.0}},
                                                         LinkMass{0.0182, {0.0175, 0.0, 0.0}}};

/// Where a finger is mounted on the platform, in the platform's frame. `stretched` is the unit
/// vector of the finger's +x, `towards_hand` that of its +z.
struct FingerMount {
  std::array<double, 3> base_m;
  std::array<double, 3> stretched;
  std::array<double, 3> towards_hand;
};
/// In the order of `core::ContactPoint`: two at the side of the palm; index and middle opposite
/// them, with the tips facing those; and the thumb from above (thesis, A.2).
inline constexpr std::array<FingerMount, core::kNumContactPoints> kFingerMounts = {
    FingerMount{{0.0527, -0.1252, 0.017}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}},
    FingerMount{{0.0527, -0.1252, -0.043}, {0.0, 1.0, 0.0}, {1.0, 0.0, 0.0}},
    FingerMount{{0.0527, -0.0010, 0.1013}, {0.0, 0.0, -1.0}, {1.0, 0.0, 0.0}},
    FingerMount{{0.0527, 0.1233, 0.007}, {0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}},
    FingerMount{{0.0527, 0.1283, -0.018}, {0.0, -1.0, 0.0}, {1.0, 0.0, 0.0}}};

/// Mechanical stops of a joint.
struct JointRange {
  double low_rad;
  double high_rad;
};
inline constexpr double kDegree_rad = std::numbers::pi / 180.0;
inline constexpr std::array<JointRange, core::kNumArmJoints> kArmRanges = {
    JointRange{-170.0 * kDegree_rad, 170.0 * kDegree_rad},
    JointRange{-120.0 * kDegree_rad, 120.0 * kDegree_rad},
    JointRange{-170.0 * kDegree_rad, 170.0 * kDegree_rad},
    JointRange{-120.0 * kDegree_rad, 120.0 * kDegree_rad},
    JointRange{-170.0 * kDegree_rad, 170.0 * kDegree_rad},
    JointRange{-120.0 * kDegree_rad, 120.0 * kDegree_rad},
    JointRange{-170.0 * kDegree_rad, 170.0 * kDegree_rad}};
/// For abduction, extension and proximal joint. The last one is also that of the distal joint.
inline constexpr std::array<JointRange, core::kNumJointsPerFinger> kFingerRanges = {
    JointRange{-20.0 * kDegree_rad, 20.0 * kDegree_rad},
    JointRange{-20.0 * kDegree_rad, 90.0 * kDegree_rad}, JointRange{0.0, 90.0 * kDegree_rad}};

/// Dry friction of a finger's joints: 0.83 N and 0.4 N at the tip, times its lever in the
/// neutral pose. The third is an assumption, because these joints moved before the base did
/// (thesis, A.4.1).
inline constexpr std::array<double, core::kNumJointsPerFinger> kFingerFriction_n_m = {
    0.0533, 0.0418, 0.0278};

// The neutral pose: the arm is in a vertical plane with the elbow up and the flange towards +x.
// The tips are where `lumped_hand_tips_m` has them, to 0.1 mm.
inline constexpr double kUpperArmTilt_rad = 1.25;  ///< From straight up, towards -y.
inline constexpr double kForearmTilt_rad = 2.70;   ///< From straight up, towards -y.
inline constexpr double kNeutralExtension_rad = 0.5;
inline constexpr double kNeutralProximal_rad = 0.5;
/// From the middle of the hand to the end effector.
inline constexpr std::array<double, 3> kNeutralEndEffector_m = {-0.135, 0.0, 0.0};

[[nodiscard]] inline Eigen::Vector3d vector_of(const std::array<double, 3>& values) noexcept {
  return {values[0], values[1], values[2]};
}

/// Returns the range of a joint between its stops.
[[nodiscard]] constexpr JointRange range_of(int joint) noexcept {
  return joint < core::kNumArmJoints
             ? kArmRanges[joint]
             : kFingerRanges[(joint - core::kNumArmJoints) % core::kNumJointsPerFinger];
}

[[nodiscard]] inline JointVector neutral_pose_rad() noexcept {
  constexpr double kQuarter_rad = 0.5 * std::numbers::pi;
  JointVector pose_rad = JointVector::Zero();
  pose_rad[0] = kQuarter_rad;
  pose_rad[1] = kUpperArmTilt_rad;
  pose_rad[3] = kUpperArmTilt_rad - kForearmTilt_rad;
  pose_rad[4] = kQuarter_rad;
  pose_rad[5] = kQuarter_rad;
  pose_rad[6] = 3.0 * kQuarter_rad - kForearmTilt_rad;
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    pose_rad[core::finger_joint(point, 1)] = kNeutralExtension_rad;
    pose_rad[core::finger_joint(point, 2)] = kNeutralProximal_rad;
  }
  return pose_rad;
}

}  // namespace jnd::device
