#include "app/gui/robot_scene.h"

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "device/drawn_mass.h"
#include "device/exoskeleton/geometry.h"

namespace jnd::app::gui {
namespace robot_scene_test {

using Eigen::Vector3d;

constexpr SceneColours kColours = {.ground = {1.0f, 1.0f, 1.0f},
                                   .force = {0.9f, 0.6f, 0.1f},
                                   .in_fluid = {0.1f, 0.2f, 0.9f},
                                   .dry = {0.4f, 0.4f, 0.4f},
                                   .loose = {0.6f, 0.2f, 0.7f},
                                   .surface = {0.1f, 0.3f, 0.9f},
                                   .solid = {0.5f, 0.5f, 0.5f}};

/// Returns a sample in which the tips of the lumped hand lie around this point, all held and in
/// the fluid.
core::Sample hand_at(const Vector3d& middle_m) {
  core::Sample sample;
  sample.attached_bits = sample.immersed_bits = 31;
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    const Vector3d tip_m = middle_m + device::lumped_hand_tips_m()[point];
    sample.tip_position_m[point] = {tip_m.x(), tip_m.y(), tip_m.z()};
  }
  return sample;
}

/// Returns a sample of the exoskeleton in its neutral pose with the hand at this point.
core::Sample exoskeleton_at(const Vector3d& middle_m) {
  core::Sample sample = hand_at(middle_m);
  const device::JointVector pose_rad = device::neutral_pose_rad();
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    sample.joint_position_rad[joint] = static_cast<float>(pose_rad[joint]);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    sample.end_effector_position_m[axis] =
        middle_m[static_cast<Eigen::Index>(axis)] + device::kNeutralEndEffector_m[axis];
  }
  return sample;
}

class RobotSceneTest : public ::testing::Test {
 protected:
  void show(const core::Sample& sample, const SurroundingsView& surroundings = {}) {
    scene_.show(sample, surroundings, kColours, camera_at_first());
  }
  /// Returns the drawn shapes of this type and colour.
  std::vector<mjvGeom> shapes(int type, const SceneColour& colour) {
    std::vector<mjvGeom> found;
    for (int i = 0; i < scene_.scene().ngeom; ++i) {
      const mjvGeom& geom = scene_.scene().geoms[i];
      if (geom.type == type && geom.rgba[0] == colour[0] && geom.rgba[1] == colour[1] &&
          geom.rgba[2] == colour[2]) {
        found.push_back(geom);
      }
    }
    return found;
  }
  int num_of_robot() {
    int count = 0;
    for (int i = 0; i < scene_.scene().ngeom; ++i) {
      count += scene_.scene().geoms[i].objtype == mjOBJ_GEOM ? 1 : 0;
    }
    return count;
  }
  static Vector3d place_of(const mjvGeom& geom) {
    return {geom.pos[0], geom.pos[1], geom.pos[2]};
  }

  RobotScene scene_;
};

TEST_F(RobotSceneTest, ADeviceWithoutJointsIsItsHandItsForcesAndTheSurface) {
  show(hand_at({0.1, 0.0, -0.15}));
  EXPECT_EQ(num_of_robot(), 0);
  EXPECT_EQ(shapes(mjGEOM_SPHERE, kColours.in_fluid).size(), 5U);
  EXPECT_EQ(shapes(mjGEOM_BOX, kColours.surface).size(), 1U);
  EXPECT_GT(scene_.scene().ngeom, 12) << "the bones of a hand";
}

TEST_F(RobotSceneTest, TheRobotStandsWhereJointsAndEndEffectorSay) {
  const Vector3d middle_m(0.05, -0.02, -0.12);
  show(exoskeleton_at(middle_m));
  EXPECT_GT(num_of_robot(), 20);
  mjModel& model = scene_.model();
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    const std::string name = std::string(core::kContactPointNames[point]) + "_tip";
    const int site = mj_name2id(&model, mjOBJ_SITE, name.c_str());
    ASSERT_GE(site, 0) << name;
    const Vector3d tip_m = Eigen::Map<const Vector3d>(scene_.data().site_xpos + 3 * site);
    const Vector3d expected_m = middle_m + device::lumped_hand_tips_m()[point];
    EXPECT_LT((tip_m - expected_m).norm(), 3e-4) << name << " is at " << tip_m.transpose();
  }
}

TEST_F(RobotSceneTest, AMovedEndEffectorMovesTheWholeRobot) {
  show(exoskeleton_at({0.0, 0.0, -0.15}));
  const int base = mj_name2id(&scene_.model(), mjOBJ_BODY, "arm_base");
  const Vector3d before_m = Eigen::Map<const Vector3d>(scene_.data().xpos + 3 * base);
  core::Sample moved = exoskeleton_at({0.0, 0.0, -0.15});
  moved.end_effector_position_m[0] += 0.2;
  show(moved);
  const Vector3d after_m = Eigen::Map<const Vector3d>(scene_.data().xpos + 3 * base);
  EXPECT_LT((after_m - before_m - Vector3d(0.2, 0.0, 0.0)).norm(), 1e-9);
}

TEST_F(RobotSceneTest, ThePersonOfTheModelIsNotDrawnForTheHandIsBetweenItsTips) {
  show(exoskeleton_at({0.0, 0.0, -0.15}));
  const int forearm = mj_name2id(&scene_.model(), mjOBJ_BODY, "forearm");
  ASSERT_GE(forearm, 0);
  for (int i = 0; i < scene_.scene().ngeom; ++i) {
    const mjvGeom& geom = scene_.scene().geoms[i];
    if (geom.objtype != mjOBJ_GEOM) continue;
    const int body = scene_.model().geom_bodyid[geom.objid];
    EXPECT_NE(scene_.model().body_rootid[body], forearm);
  }
}

TEST_F(RobotSceneTest, AForceIsAnArrowFromItsTipOfThreeCentimetresANewton) {
  core::Sample sample = hand_at({0.0, 0.0, -0.15});
  sample.tip_force_n[3] = {0.0, -2.0, 0.0};
  show(sample);
  const std::vector<mjvGeom> arrows = shapes(mjGEOM_ARROW, kColours.force);
  ASSERT_EQ(arrows.size(), 1U) << "none for no force";
  // MuJoCo draws an arrow half as long as its size.
  EXPECT_NEAR(0.5 * arrows[0].size[2], 2.0 * 0.03, 1e-6);
  const Vector3d tip_m(sample.tip_position_m[3].data());
  EXPECT_LT((place_of(arrows[0]) - tip_m).norm(), 1e-6);
  // The third column of its axes is its direction.
  EXPECT_NEAR(arrows[0].mat[5], -1.0, 1e-6);
}

TEST_F(RobotSceneTest, PointsAreToldApartByTheirShapes) {
  core::Sample sample = hand_at({0.0, 0.0, -0.02});
  sample.immersed_bits = 0b00011;
  sample.attached_bits = 0b10111;
  show(sample);
  const std::vector<mjvGeom> wet = shapes(mjGEOM_SPHERE, kColours.in_fluid);
  const std::vector<mjvGeom> dry = shapes(mjGEOM_SPHERE, kColours.dry);
  ASSERT_EQ(wet.size(), 2U);
  ASSERT_EQ(dry.size(), 2U);
  EXPECT_GT(wet[0].size[0], dry[0].size[0]);
  const std::vector<mjvGeom> loose = shapes(mjGEOM_BOX, kColours.loose);
  ASSERT_EQ(loose.size(), 1U);
  EXPECT_LT((place_of(loose[0]) - Vector3d(sample.tip_position_m[3].data())).norm(), 1e-6);
}

TEST_F(RobotSceneTest, TheSurfaceIsAtItsHeightAndOpaqueWhereItIsSolid) {
  core::Immersion immersion;
  immersion.origin_z_m = -0.05;
  show(hand_at({0.0, 0.0, -0.15}), {.immersion = immersion});
  const std::vector<mjvGeom> fluid = shapes(mjGEOM_BOX, kColours.surface);
  ASSERT_EQ(fluid.size(), 1U);
  EXPECT_NEAR(fluid[0].pos[2], -0.05, 1e-6);
  EXPECT_LT(fluid[0].rgba[3], 0.5f);
  show(hand_at({0.0, 0.0, -0.15}), {.immersion = immersion, .surface_is_solid = true});
  const std::vector<mjvGeom> solid = shapes(mjGEOM_BOX, kColours.solid);
  ASSERT_EQ(solid.size(), 1U);
  EXPECT_GT(solid[0].rgba[3], 0.5f);
}

TEST_F(RobotSceneTest, AContainerHasItsWallItsFloorAndARoundSurface) {
  core::Immersion bucket;
  bucket.radius_m = 0.2;
  bucket.depth_m = 0.3;
  bucket.origin_x_m = 0.1;
  show(hand_at({0.1, 0.0, -0.15}), {.immersion = bucket, .has_walls = true});
  const std::vector<mjvGeom> fluid = shapes(mjGEOM_CYLINDER, kColours.surface);
  ASSERT_EQ(fluid.size(), 1U);
  EXPECT_LT(fluid[0].size[2], 0.001f) << "flat";
  const std::vector<mjvGeom> solid = shapes(mjGEOM_CYLINDER, kColours.solid);
  ASSERT_EQ(solid.size(), 2U);
  EXPECT_NEAR(solid[0].pos[2], -0.3, 1e-6) << "the floor";
  EXPECT_NEAR(solid[1].size[0], 0.2, 1e-6) << "the wall";
  EXPECT_NEAR(solid[1].size[2], 0.15, 1e-6) << "half its height";
  EXPECT_NEAR(solid[1].pos[0], 0.1, 1e-6);
}

TEST_F(RobotSceneTest, WhatIsNotFiniteIsLeftOutAndTheRestStays) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  core::Sample sample = exoskeleton_at({0.0, 0.0, -0.15});
  show(sample);
  sample.tip_position_m[4] = {kNan, 0.0, 0.0};
  sample.tip_force_n[1] = {kNan, 1.0, 0.0};
  sample.tip_force_n[2] = {std::numeric_limits<double>::infinity(), 1.0, 0.0};
  sample.joint_position_rad[0] = static_cast<float>(kNan);
  sample.end_effector_position_m = {kNan, kNan, kNan};
  show(sample);
  EXPECT_EQ(shapes(mjGEOM_SPHERE, kColours.in_fluid).size(), 4U);
  EXPECT_TRUE(shapes(mjGEOM_ARROW, kColours.force).empty());
  for (int i = 0; i < scene_.scene().ngeom; ++i) {
    for (const float coordinate : scene_.scene().geoms[i].pos) {
      EXPECT_TRUE(std::isfinite(coordinate));
    }
  }
}

TEST_F(RobotSceneTest, AFingerThatCameOffHasNoBoneToTheHand) {
  show(hand_at({0.0, 0.0, -0.15}));
  const int whole = scene_.scene().ngeom;
  core::Sample sample = hand_at({0.0, 0.0, -0.15});
  sample.attached_bits = 0b11011;
  show(sample);
  EXPECT_EQ(scene_.scene().ngeom, whole - 1);
}

TEST(SceneColours, AreThoseOfTheThemeInBothModes) {
  Theme theme(1.0f, false);
  EXPECT_EQ(scene_colours(theme).ground, (SceneColour{1.0f, 1.0f, 1.0f}));
  const SceneColours light = scene_colours(theme);
  theme.set_dark(true);
  EXPECT_NE(scene_colours(theme), light);
  EXPECT_LT(scene_colours(theme).ground[0], 0.2f);
}

}  // namespace robot_scene_test
}  // namespace jnd::app::gui
