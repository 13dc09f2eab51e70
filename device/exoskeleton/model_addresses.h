#pragma once

#include <array>

#include "core/hand.h"
#include "core/joints.h"

struct mjModel_;

namespace jnd::device {

/// Addresses in data/models/exoskeleton.xml of everything that the program knows by name.
struct ModelAddresses {
  /// Throws `core::Error` naming what is missing. Not real time.
  explicit ModelAddresses(const mjModel_& model);

  // Addresses in qpos and in qvel.
  std::array<int, core::kNumJoints> position{}, dof{};
  std::array<int, core::kNumContactPoints> distal_position{}, distal_dof{};
  std::array<int, 3> hand_position{}, hand_dof{};
  // Sites, bodies and equalities.
  std::array<int, core::kNumContactPoints> tip_site{}, distal_body{}, magnet{};
  std::array<int, core::kNumArmJoints> brake{};
  int arm_base_body = 0, platform_body = 0, forearm_body = 0;
};

}  // namespace jnd::device
