// Tests solid surfaces, the workspace, and a device that disappears during a contact.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "haptic_loop_fixture.h"
#include "haptic_loop_scene.h"

namespace jnd::device {
namespace haptic_loop_contact_test {

using core::Fault;

/// Runs and expects that every tick is safe. Returns the largest step of the force at a point.
double run_safely(LoopScene& scene, int num_ticks) {
  double max_step_n = 0.0;
  core::PointVectors last = scene.last_received();
  for (int tick = 0; tick < num_ticks; ++tick) {
    scene.run(1);
    const core::PointVectors now = scene.last_received();
    EXPECT_TRUE(is_safe(now, last, scene.device.state.attached)) << tick;
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      max_step_n = std::max(max_step_n, (now[i] - last[i]).norm());
      EXPECT_GE(now[i].z(), scene.device.state.tip_velocity_m_per_s[i].z() < 0.0 ? 0.0 : -10.0)
          << "a hand on its way down is never pulled in";
    }
    last = now;
  }
  return max_step_n;
}

core::MediumAmounts hard_plane() {
  return core::solid(
      {.stiffness_n_per_m = 2000.0, .damping_n_s_per_m = 2.0, .friction_ratio = 0.5});
}

TEST(HapticLoopContact, AHandThatBeginsInsideThePlaneIsNotThrownOut) {
  for (const auto& attached : kAttachments) {
    LoopScene scene(attached);
    scene.device.move_all(Eigen::Vector3d::Zero());
    scene.command.medium = hard_plane();
    scene.command.immersion.origin_z_m = 0.0;  // The hand is 10 cm below the surface.
    scene.command.ramp_s = 0.0;
    scene.publish();
    // The hand moves at 5 cm/s into 2000 N/m, of which the palm bears 35 %.
    EXPECT_LE(run_safely(scene, 500), 0.35 * 2000.0 * 0.05 * 0.001 + 1e-9);
  }
}

TEST(HapticLoopContact, AnImpactAtThreeMetresPerSecondStaysWithinTheLimits) {
  for (const auto& attached : kAttachments) {
    LoopScene scene(attached);
    scene.command.medium = core::solid(
        {.stiffness_n_per_m = 100'000.0, .damping_n_s_per_m = 100.0, .friction_ratio = 1.0});
    scene.command.immersion.origin_z_m = -0.15;
    scene.command.ramp_s = 0.0;
    scene.publish();
    scene.device.move_all({1.0, 0.0, -3.0});
    run_safely(scene, 100);
    EXPECT_GT(sum_of_magnitudes_n(scene.last_received()), 9.0);
    scene.device.move_all({1.0, 0.0, 3.0});
    run_safely(scene, 200);
    EXPECT_EQ(sum_of_magnitudes_n(scene.last_received()), 0.0) << "above it again";
    EXPECT_EQ(scene.fault(), Fault::kNone);
  }
}

TEST(HapticLoopContact, APlaneMovedInContactIsNoStep) {
  LoopScene scene;
  scene.command.medium = hard_plane();
  scene.command.ramp_s = 0.0;
  scene.publish();
  scene.run(150);
  scene.device.move_all(Eigen::Vector3d::Zero());
  scene.run(10);
  const double before_n = sum_of_magnitudes_n(scene.last_received());
  ASSERT_GT(before_n, 1.0);
  scene.command.immersion.origin_z_m += 0.05;
  scene.publish();
  EXPECT_LE(run_safely(scene, 20), 0.35 * 2000.0 * 0.05 * 0.001 + 1e-9);
  scene.command.immersion.origin_z_m -= 0.10;
  scene.publish();
  run_safely(scene, 20);
  EXPECT_EQ(sum_of_magnitudes_n(scene.last_received()), 0.0) << "gone, it holds nothing";
}

TEST(HapticLoopContact, AParameterThatJumpsInContactIsBoundedByTheSlew) {
  for (const auto amount : {&core::MediumAmounts::plane_stiffness_n_per_m,
                            &core::MediumAmounts::plane_damping_n_s_per_m,
                            &core::MediumAmounts::plane_friction_n_per_m}) {
    for (const double value : {0.0, 1.0, 1e4, 1e9, 1e300}) {
      LoopScene scene;
      scene.bring_to(Phase::kInContact);
      scene.command.medium.*amount = value;
      scene.command.ramp_s = 0.0;
      scene.publish();
      run_safely(scene, 100);
    }
  }
}

TEST(HapticLoopContact, ABucketHoldsTheHandAndItsFluid) {
  LoopScene scene;
  scene.command.medium = core::viscous({.viscosity_pa_s = 5.0}) +
                         core::container({.stiffness_n_per_m = 500.0, .friction_ratio = 0.2});
  scene.command.immersion = {.radius_m = 0.15, .depth_m = 0.2};
  scene.publish();
  scene.device.move_all({0.2, 0.0, 0.0});
  run_safely(scene, 850);  // The hand is 17 cm aside, which is 2 cm behind the wall.
  scene.published_telemetry.fetch();
  EXPECT_EQ(scene.published_telemetry.value().sample.immersed_bits, 0b11111)
      << "still in the fluid";
  EXPECT_EQ(scene.fault(), Fault::kNone);
  EXPECT_LT(scene.device.last_total_n().x(), -5.0);
}

TEST(HapticLoopContact, APointOutsideTheWorkspaceLatchesUntilItIsBack) {
  for (const auto& attached : kAttachments) {
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      LoopScene scene(attached, {.workspace = {.half_width_y_m = 0.5}});
      scene.bring_to(Phase::kInContact);
      scene.device.state.tip_position_m[point].y() = 0.499;
      scene.device.state.tip_velocity_m_per_s[point] = {0.0, 0.1, 0.0};
      scene.run(1);
      scene.loop.rearm();  // This follows the jump that the test itself made.
      scene.run(5);
      EXPECT_EQ(scene.fault(), Fault::kNone);
      scene.run(10);
      if (!attached[point]) {
        EXPECT_EQ(scene.fault(), Fault::kNone) << "what dangles may hang out";
        continue;
      }
      EXPECT_EQ(scene.fault(), Fault::kOutsideWorkspace);
      EXPECT_EQ(sum_of_magnitudes_n(scene.last_received()), 0.0);
      scene.loop.rearm();
      scene.run(5);
      EXPECT_EQ(scene.fault(), Fault::kOutsideWorkspace) << "armed outside it is not armed";
      scene.device.state.tip_velocity_m_per_s[point] = {0.0, -0.1, 0.0};
      scene.run(30);
      EXPECT_EQ(scene.fault(), Fault::kOutsideWorkspace) << "latched";
      scene.loop.rearm();
      scene.run(5);
      EXPECT_EQ(scene.fault(), Fault::kNone);
    }
  }
}

/// The faults of a device that disappears in contact, and what the loop calls them.
struct Absence {
  const char* name;
  Injection injection;
  Fault fault;
  std::size_t ticks_allowed;
};

class HapticLoopAbsenceTest : public HapticLoopTest,
                              public ::testing::WithParamInterface<Absence> {};

TEST_P(HapticLoopAbsenceTest, ComesBackInContactWithoutASpike) {
  const Absence& absence = GetParam();
  make_loop({{300, 50, absence.injection}});
  for (Eigen::Vector3d& position : device.state.tip_position_m) position.z() = 0.002;
  device.move_all({0.08, 0.0, -0.03});
  command(core::solid({.stiffness_n_per_m = 2000.0, .friction_ratio = 0.5}) +
          core::viscous({.viscosity_pa_s = 5.0}));
  run(300);
  ASSERT_GT(max_received_n(299), 1.0);
  run(absence.injection == Injection::kReadFailure ? 50 : 60);
  EXPECT_EQ(max_received_n(300 + absence.ticks_allowed), 0.0);
  EXPECT_EQ(telemetry().fault, absence.fault);
  // Meanwhile the hand has moved elsewhere, and deeper.
  for (Eigen::Vector3d& position : device.state.tip_position_m) {
    position += Eigen::Vector3d(0.2, 0.1, -0.05);
  }
  run(20);
  const std::size_t armed_at = device.received.size();
  loop->rearm();
  core::PointVectors last = core::zero_vectors();
  for (int tick = 0; tick < 300; ++tick) {
    run(1);
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      ASSERT_LT((device.received.back()[i] - last[i]).norm(), 0.1) << tick;
    }
    last = device.received.back();
  }
  EXPECT_EQ(telemetry().fault, Fault::kNone);
  EXPECT_GT(max_received_n(armed_at), 1.0) << "and it is there again";
}

INSTANTIATE_TEST_SUITE_P(
    Every, HapticLoopAbsenceTest,
    ::testing::Values(
        Absence{"Unplugged", Injection::kReadFailure, Fault::kDeviceReadFailed, 0},
        Absence{"NotWritten", Injection::kWriteFailure, Fault::kDeviceWriteFailed, 0},
        Absence{"Frozen", Injection::kFrozenSample, Fault::kStaleSample, 36},
        Absence{"TimeStandsStill", Injection::kStaleTime, Fault::kStaleSample, 5}),
    [](const auto& info_of_it) { return std::string(info_of_it.param.name); });

}  // namespace haptic_loop_contact_test
}  // namespace jnd::device
