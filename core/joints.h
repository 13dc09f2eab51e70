#pragma once

#include <array>
#include <string_view>

namespace jnd::core {

/// The joints of an exoskeleton that is carried by an arm, in the order of every array of
/// joints. First come the arm's joints from its base on. Then come those of each finger, in the
/// order of `ContactPoint`: abduction and extension of its base, and extension of its proximal
/// joint. The distal joint follows the proximal one 1:1 and is no degree of freedom of its own.
inline constexpr int kNumArmJoints = 7;
inline constexpr int kNumJointsPerFinger = 3;
inline constexpr int kNumJoints = 22;

inline constexpr std::array<std::string_view, kNumJoints> kJointNames = {
    "arm_1",
    "arm_2",
    "arm_3",
    "arm_4",
    "arm_5",
    "arm_6",
    "arm_7",
    "palm_inner_abduction",
    "palm_inner_extension",
    "palm_inner_proximal",
    "palm_outer_abduction",
    "palm_outer_extension",
    "palm_outer_proximal",
    "thumb_abduction",
    "thumb_extension",
    "thumb_proximal",
    "index_abduction",
    "index_extension",
    "index_proximal",
    "middle_abduction",
    "middle_extension",
    "middle_proximal",
};

/// Returns the index of a finger's joint: 0 abduction, 1 extension, 2 proximal.
[[nodiscard]] constexpr int finger_joint(int contact_point, int joint) noexcept {
  return kNumArmJoints + kNumJointsPerFinger * contact_point + joint;
}

}  // namespace jnd::core
