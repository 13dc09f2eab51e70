#include "device/exoskeleton/exoskeleton_device.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "core/error.h"
#include "core/random_stream.h"
#include "device/exoskeleton/exoskeleton_options.h"
#include "device/exoskeleton/mujoco_fixture.h"
#include "device/haptic_loop.h"
#include "device/registry/device_registry.h"
#include "support/allocation_counter.h"
#include "support/sanitizer.h"

namespace jnd::device {
namespace exoskeleton_device_test {

using Eigen::Vector3d;
using Parameters = ExoskeletonDevice::Parameters;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The device, which a loop drives through a medium.
struct Laboratory {
  explicit Laboratory(const Parameters& parameters = {})
      : exoskeleton(parameters),
        loop({.starts_armed = true, .rate_hz = parameters.rate_hz}, exoskeleton,
             {commands, telemetry, stop}) {}

  void feel(const core::MediumAmounts& medium) {
    commands.publish({.sequence = ++sequence, .medium = medium, .ramp_s = 0.0});
    for (int i = 0; i < 20; ++i) tick();
  }

  core::ContactSums stroke(const StrokePlan& plan) {
    const core::ContactSums from = exoskeleton.contact_sums();
    SimulatedHand& hand = *exoskeleton.simulated_hand();
    hand.begin_strokes(plan, core::RandomStream(5, "stroke", {1}));
    while (hand.strokes_finished() < plan.num_strokes &&
           telemetry.value().fault == core::Fault::kNone) {
      tick();
    }
    return exoskeleton.contact_sums() - from;
  }

  void tick() {
    loop.tick();
    telemetry.fetch();
    ASSERT_TRUE(exoskeleton.read(state));
    low_m = std::min(low_m, exoskeleton.world().hand_position_m().x());
    high_m = std::max(high_m, exoskeleton.world().hand_position_m().x());
    fastest_m_per_s =
        std::max(fastest_m_per_s, std::abs(exoskeleton.world().hand_velocity_m_per_s().x()));
    // How far the finger tips are behind the palm, against the motion.
    const double behind_m = 0.5 * (state.tip_position_m[3] + state.tip_position_m[4] -
                                   state.tip_position_m[0] - state.tip_position_m[1])
                                      .x();
    if (exoskeleton.world().hand_velocity_m_per_s().x() > 0.3) {
      trailing_m = std::min(trailing_m, behind_m);
    }
  }

  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  ExoskeletonDevice exoskeleton;
  HapticLoop loop;
  core::HapticState state;
  std::uint64_t sequence = 0;
  double low_m = 1.0, high_m = -1.0, fastest_m_per_s = 0.0, trailing_m = 0.0;
};

core::PointVectors at_every_point(const Vector3d& force_n) {
  core::PointVectors forces;
  forces.fill(force_n);
  return forces;
}

TEST(ExoskeletonDevice, IsInTheRegistryAndSaysWhatItIs) {
  const auto device = make_device("exoskeleton", 833.0);
  EXPECT_EQ(device->name(), "exoskeleton");
  const DeviceCapabilities capabilities = device->capabilities();
  EXPECT_EQ(capabilities.rate_hz, 833.0);
  EXPECT_EQ(capabilities.num_joints, core::kNumJoints);
  EXPECT_TRUE(capabilities.simulated);
  EXPECT_TRUE(capabilities.moves_by_itself);
  EXPECT_NE(device->simulated_hand(), nullptr);
}

TEST(ExoskeletonDevice, StartsAtHomeAtRestWithFiveMagnetsHolding) {
  ExoskeletonDevice exoskeleton(Parameters{.arm = {.home_z_m = -0.1}});
  exoskeleton.open();
  core::HapticState state;
  ASSERT_TRUE(exoskeleton.read(state));
  EXPECT_EQ(state.device_time_ns, 0);
  EXPECT_EQ(state.attached, core::kAllAttached);
  Vector3d mean_m = Vector3d::Zero();
  for (const Vector3d& tip : state.tip_position_m) mean_m += tip / core::kNumContactPoints;
  EXPECT_LT((mean_m - Vector3d(0.0, 0.0, -0.1)).norm(), 2e-4);
  EXPECT_LT((state.end_effector_position_m - Vector3d(-0.135, 0.0, -0.1)).norm(), 2e-4);
  EXPECT_NEAR(state.joint_position_rad[1], 1.25, 1e-12);
  ASSERT_TRUE(exoskeleton.write(core::zero_vectors()));
  ASSERT_TRUE(exoskeleton.read(state));
  EXPECT_EQ(state.device_time_ns, 1'000'000);
}

TEST(ExoskeletonDevice, VelocitiesAreThoseOfTheMovingHand) {
  Laboratory laboratory;
  laboratory.exoskeleton.simulated_hand()->begin_strokes({}, core::RandomStream(1, "stroke"));
  double error_m_per_s = 0.0;
  for (int i = 0; i < 3000; ++i) {
    laboratory.tick();
    const Vector3d difference = laboratory.state.tip_velocity_m_per_s[0] -
                                laboratory.exoskeleton.world().hand_velocity_m_per_s();
    error_m_per_s = std::max(error_m_per_s, difference.norm());
  }
  EXPECT_GT(laboratory.fastest_m_per_s, 0.35);
  EXPECT_LT(error_m_per_s, 0.08);
}

TEST(ExoskeletonDevice, StrokesThroughEveryMediumAtBothRates) {
  for (const double rate_hz : {1000.0, 833.0}) {
    double last_fastest_m_per_s = 1.0, last_trailing_m = 1.0;
    for (const double viscosity_pa_s : {0.0, 1.0, 4.0, 16.0, 30.0}) {
      Laboratory laboratory(Parameters{.rate_hz = rate_hz});
      if (viscosity_pa_s > 0.0) {
        laboratory.feel(core::viscous({.viscosity_pa_s = viscosity_pa_s}));
      }
      const core::ContactSums felt = laboratory.stroke({.num_strokes = 2});
      const core::Telemetry& now = laboratory.telemetry.value();
      EXPECT_EQ(now.fault, core::Fault::kNone) << viscosity_pa_s << " at " << rate_hz;
      EXPECT_EQ(laboratory.state.attached, core::kAllAttached) << viscosity_pa_s;
      EXPECT_GT(laboratory.high_m - laboratory.low_m, 0.3) << viscosity_pa_s;
      EXPECT_LT(laboratory.fastest_m_per_s, last_fastest_m_per_s + 0.01) << viscosity_pa_s;
      EXPECT_NEAR(felt.delivered_damping_n_s_per_m(), 1.776 * viscosity_pa_s,
                  0.1 * 1.776 * viscosity_pa_s + 1e-9);
      if (viscosity_pa_s >= 4.0) {
        EXPECT_LT(laboratory.trailing_m, last_trailing_m) << "fingers are dragged behind";
        last_trailing_m = laboratory.trailing_m;
      }
      last_fastest_m_per_s = laboratory.fastest_m_per_s;
    }
  }
}

TEST(ExoskeletonDevice, NothingWindsUpOverManyStrokes) {
  Laboratory laboratory;
  laboratory.feel(core::viscous({.viscosity_pa_s = 2.0}));
  laboratory.exoskeleton.simulated_hand()->begin_strokes({.amplitude_m = 0.3},
                                                         core::RandomStream(6, "stroke"));
  double turn_rad = 0.0, elbow_rad = 0.0, lag_m = 0.0;
  for (int i = 0; i < 30000; ++i) {
    laboratory.tick();
    turn_rad =
        std::max(turn_rad, laboratory.exoskeleton.kinematics().platform_turn_rad().norm());
    elbow_rad = std::max(elbow_rad, std::abs(laboratory.state.joint_position_rad[2]));
    lag_m = std::max(lag_m, (laboratory.state.end_effector_position_m + Vector3d(0.135, 0, 0) -
                             laboratory.exoskeleton.world().hand_position_m())
                                .norm());
  }
  EXPECT_LT(turn_rad, 0.2);
  EXPECT_LT(elbow_rad, 0.7);
  EXPECT_LT(lag_m, 0.06);
  EXPECT_EQ(laboratory.state.attached, core::kAllAttached);
}

TEST(ExoskeletonDevice, StrokesThroughWater) {
  Laboratory laboratory;
  laboratory.feel(core::water({.scale = 4.0}));
  laboratory.stroke({.num_strokes = 2});
  EXPECT_EQ(laboratory.telemetry.value().fault, core::Fault::kNone);
  EXPECT_GT(laboratory.high_m - laboratory.low_m, 0.4);
}

/// Returns the slope of the opposing force on speed without dry friction: the regression line
/// through all ticks of some strokes of different speeds.
double free_space_viscosity_n_s_per_m(double* friction_n) {
  Laboratory laboratory;
  double num = 0.0, sum_v = 0.0, sum_f = 0.0, sum_vv = 0.0, sum_vf = 0.0;
  for (const double speed_m_per_s : {0.15, 0.3, 0.45, 0.6}) {
    laboratory.stroke({.max_speed_m_per_s = speed_m_per_s, .num_strokes = 1});
    core::ContactSums last = laboratory.exoskeleton.contact_sums();
    SimulatedHand& hand = *laboratory.exoskeleton.simulated_hand();
    hand.begin_strokes({.max_speed_m_per_s = speed_m_per_s, .num_strokes = 2},
                       core::RandomStream(5, "stroke", {2}));
    while (hand.strokes_finished() < 2) {
      laboratory.tick();
      const core::ContactSums now = laboratory.exoskeleton.contact_sums();
      const double v = (now - last).speed_m_per_s, f = (now - last).opposing_n;
      last = now;
      num += 1.0, sum_v += v, sum_f += f, sum_vv += v * v, sum_vf += v * f;
    }
  }
  const double slope = (num * sum_vf - sum_v * sum_f) / (num * sum_vv - sum_v * sum_v);
  *friction_n = (sum_f - slope * sum_v) / num;
  return slope;
}

TEST(ExoskeletonDevice, FreeSpaceFeelsLikeAThinFluid) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  double friction_n = 0.0;
  const double viscosity_n_s_per_m = free_space_viscosity_n_s_per_m(&friction_n);
  std::printf("free space: %.2f N s/m, %.2f N\n", viscosity_n_s_per_m, friction_n);
  EXPECT_GT(viscosity_n_s_per_m, 3.0);
  EXPECT_LT(viscosity_n_s_per_m, 7.0);
  EXPECT_LT(std::abs(friction_n), 2.0);
}

TEST(ExoskeletonDevice, RepeatsARunToTheBitFromOpen) {
  const auto run = [](ExoskeletonDevice& exoskeleton) {
    exoskeleton.open();
    core::HapticState state;
    exoskeleton.simulated_hand()->begin_strokes({}, core::RandomStream(3, "stroke"));
    for (int tick = 0; tick < 800; ++tick) {
      EXPECT_TRUE(exoskeleton.read(state));
      EXPECT_TRUE(exoskeleton.write(at_every_point(-2.0 * state.tip_velocity_m_per_s[0])));
      if (tick == 400) exoskeleton.detach(3);
      if (tick == 500) exoskeleton.attach(3);
    }
    EXPECT_TRUE(exoskeleton.read(state));
    return state;
  };
  ExoskeletonDevice one(Parameters{.extra_delay_s = 0.002});
  ExoskeletonDevice two(Parameters{.extra_delay_s = 0.002});
  const core::HapticState first = run(one);
  for (const core::HapticState& again : {run(one), run(two)}) {
    EXPECT_EQ(
        std::memcmp(&first.tip_position_m, &again.tip_position_m, sizeof first.tip_position_m),
        0);
    EXPECT_EQ(std::memcmp(&first.joint_torque_n_m, &again.joint_torque_n_m,
                          sizeof first.joint_torque_n_m),
              0);
  }
}

TEST(ExoskeletonDevice, AForceThatIsNoNumberIsRefusedAndHarmless) {
  for (const double broken : {kNan, kInfinity, -kInfinity}) {
    for (const double delay_s : {0.0, 0.003}) {
      ExoskeletonDevice exoskeleton(Parameters{.extra_delay_s = delay_s});
      exoskeleton.open();
      core::HapticState state;
      for (int i = 0; i < 20; ++i)
        ASSERT_TRUE(exoskeleton.write(at_every_point({1.0, 0.0, 0.0})));
      core::PointVectors forces = core::zero_vectors();
      forces[2].y() = broken;
      EXPECT_FALSE(exoskeleton.write(forces));
      EXPECT_EQ(exoskeleton.fault(), core::Fault::kNonFiniteForce);
      EXPECT_FALSE(exoskeleton.write(at_every_point({1.0, 0.0, 0.0})))
          << "until there were zeros";
      ASSERT_TRUE(exoskeleton.read(state));
      EXPECT_TRUE(exoskeleton.write(core::zero_vectors()));
      EXPECT_EQ(exoskeleton.fault(), core::Fault::kNone);
      for (int i = 0; i < 100; ++i)
        ASSERT_TRUE(exoskeleton.write(at_every_point({1.0, 0.0, 0.0})));
      ASSERT_TRUE(exoskeleton.read(state));
      for (const Vector3d& tip : state.tip_position_m) EXPECT_TRUE(tip.allFinite());
      EXPECT_TRUE(std::isfinite(exoskeleton.contact_sums().opposing_n));
    }
  }
}

TEST(ExoskeletonDevice, AnInvalidSimulationEndsInAFaultUntilOpenedAgain) {
  Laboratory laboratory;
  laboratory.tick();
  laboratory.exoskeleton.load_tip(2, {kNan, 0.0, 0.0});
  laboratory.loop.tick();
  laboratory.telemetry.fetch();
  EXPECT_EQ(laboratory.telemetry.value().fault, core::Fault::kSimulationInvalid);
  EXPECT_FALSE(laboratory.exoskeleton.read(laboratory.state));
  EXPECT_FALSE(laboratory.exoskeleton.write(core::zero_vectors()));
  laboratory.loop.rearm();
  laboratory.loop.tick();
  laboratory.telemetry.fetch();
  EXPECT_EQ(laboratory.telemetry.value().fault, core::Fault::kSimulationInvalid);
  laboratory.exoskeleton.open();
  laboratory.loop.rearm();
  laboratory.tick();
  EXPECT_EQ(laboratory.telemetry.value().fault, core::Fault::kNone);
}

TEST(ExoskeletonDevice, TheDelayHoldsTheForceBack) {
  // Returns the first tick in which the sensor of a finger shows the commanded force.
  const auto first_tick_of_torque = [](double delay_s) {
    ExoskeletonDevice exoskeleton(Parameters{.extra_delay_s = delay_s});
    exoskeleton.open();
    core::HapticState state;
    const int joint = core::finger_joint(0, 1);
    EXPECT_TRUE(exoskeleton.read(state));
    const double rest_n_m = state.joint_torque_n_m[joint];
    for (int tick = 0; tick < 50; ++tick) {
      EXPECT_TRUE(exoskeleton.write(at_every_point({5.0, 0.0, 0.0})));
      EXPECT_TRUE(exoskeleton.read(state));
      if (std::abs(state.joint_torque_n_m[joint] - rest_n_m) > 0.1) return tick;
    }
    return -1;
  };
  const int at_once = first_tick_of_torque(0.0);
  EXPECT_EQ(at_once, 0);
  EXPECT_EQ(first_tick_of_torque(0.001), at_once + 1);
  EXPECT_EQ(first_tick_of_torque(0.003), at_once + 3);
}

TEST(ExoskeletonDevice, AHaltLastsUntilZerosAreWritten) {
  for (const double delay_s : {0.0, 0.003}) {
    ExoskeletonDevice exoskeleton(Parameters{.extra_delay_s = delay_s});
    exoskeleton.open();
    for (int i = 0; i < 20; ++i) {
      ASSERT_TRUE(exoskeleton.write(at_every_point({5.0, 0.0, 0.0})));
    }
    exoskeleton.halt();
    core::HapticState state;
    // Neither a force that was still on its way nor one that a late tick writes may arrive any
    // more.
    const int joint = core::finger_joint(0, 1);
    for (int i = 0; i < 5; ++i) {
      ASSERT_TRUE(exoskeleton.write(at_every_point({5.0, 0.0, 0.0})));
      ASSERT_TRUE(exoskeleton.read(state));
      EXPECT_LT(state.joint_torque_n_m[joint], 0.15) << delay_s;
    }
    ASSERT_TRUE(exoskeleton.write(core::zero_vectors()));
    for (int i = 0; i < 5; ++i) {
      ASSERT_TRUE(exoskeleton.write(at_every_point({5.0, 0.0, 0.0})));
    }
    ASSERT_TRUE(exoskeleton.read(state));
    EXPECT_GT(state.joint_torque_n_m[joint], 0.15) << delay_s;
  }
}

TEST(ExoskeletonDevice, ItsWeightIsHeldWhileForcesEndAndWhileItIsHalted) {
  Laboratory laboratory;
  laboratory.exoskeleton.open();
  laboratory.feel(core::viscous({.viscosity_pa_s = 8.0}));
  for (int i = 0; i < 500; ++i) laboratory.tick();
  const double height_m = laboratory.state.end_effector_position_m.z();
  laboratory.stop.press();
  for (int i = 0; i < 1000; ++i) laboratory.tick();
  EXPECT_NEAR(laboratory.state.end_effector_position_m.z(), height_m, 0.005) << "stopped";
  laboratory.exoskeleton.halt();
  for (int i = 0; i < 1000; ++i) {
    ASSERT_TRUE(laboratory.exoskeleton.write(at_every_point({0.0, 0.0, 1.0})));
  }
  ASSERT_TRUE(laboratory.exoskeleton.read(laboratory.state));
  EXPECT_NEAR(laboratory.state.end_effector_position_m.z(), height_m, 0.005) << "halted";
}

TEST(ExoskeletonDevice, WhatWasOnItsWayBeforeAFaultDoesNotComeAfterIt) {
  ExoskeletonDevice exoskeleton(Parameters{.extra_delay_s = 0.003});
  exoskeleton.open();
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(exoskeleton.write(at_every_point({5.0, 0.0, 0.0})));
  EXPECT_FALSE(exoskeleton.write(at_every_point({kNan, 0.0, 0.0})));
  core::HapticState state;
  for (int i = 0; i < 5; ++i) {
    ASSERT_TRUE(exoskeleton.write(core::zero_vectors()));
    ASSERT_TRUE(exoskeleton.read(state));
    EXPECT_LT(state.joint_torque_n_m[core::finger_joint(0, 1)], 0.15) << i;
  }
}

TEST(ExoskeletonDevice, KeepsToItsOwnLimitsWhateverIsWritten) {
  core::RandomStream random(1, "force");
  ExoskeletonDevice bounded(
      Parameters{.max_force_per_point_n = 4.0, .max_total_force_n = 10.0});
  ExoskeletonDevice asked_within(
      Parameters{.max_force_per_point_n = 4.0, .max_total_force_n = 10.0});
  bounded.open();
  asked_within.open();
  for (int i = 0; i < 50; ++i) {
    const Vector3d direction =
        random.normal(0.0, 1.0) > 0.0 ? Vector3d(1, 0, 0) : Vector3d(0, 0, 1);
    // Five points of 1000 N each become 2 N each: 4 N at a point, scaled to 10 N in all.
    ASSERT_TRUE(bounded.write(at_every_point(1000.0 * direction)));
    ASSERT_TRUE(asked_within.write(at_every_point(2.0 * direction)));
    core::HapticState one, other;
    ASSERT_TRUE(bounded.read(one));
    ASSERT_TRUE(asked_within.read(other));
    for (int joint = 0; joint < core::kNumJoints; ++joint) {
      EXPECT_NEAR(one.joint_torque_n_m[joint], other.joint_torque_n_m[joint], 1e-9);
    }
  }
}

TEST(ExoskeletonDevice, OrdersOfBeforeItWasOpenedAreForgotten) {
  ExoskeletonDevice exoskeleton(Parameters{});
  SimulatedHand& hand = *exoskeleton.simulated_hand();
  hand.begin_strokes({}, core::RandomStream(1, "stroke"));
  hand.put_fingers_back();
  exoskeleton.open();
  EXPECT_TRUE(hand.is_home());
  core::HapticState state;
  ASSERT_TRUE(exoskeleton.read(state));
  const double home_x_m = state.end_effector_position_m.x();
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(exoskeleton.write(core::zero_vectors()));
  ASSERT_TRUE(exoskeleton.read(state));
  EXPECT_NEAR(state.end_effector_position_m.x(), home_x_m, 0.005);
  EXPECT_TRUE(hand.is_home());
}

TEST(ExoskeletonDevice, OptionsSetFeedForwardAndLockTheArm) {
  const ExoskeletonDevice::Parameters parameters =
      exoskeleton_parameters("feed-forward=1.5,compensated,arm-locked");
  EXPECT_EQ(parameters.control.feed_forward_gain_ratio, 1.5);
  EXPECT_TRUE(parameters.control.compensates_feed_forward);
  EXPECT_TRUE(parameters.arm_joint_locked[6]);
  EXPECT_FALSE(exoskeleton_parameters("").control.compensates_feed_forward);
  for (const char* wrong : {"x", "feed-forward=", "feed-forward=-1", "feed-forward=1x",
                            "compensated,,arm-locked", "feed-forward=nan"}) {
    EXPECT_THROW((void)exoskeleton_parameters(wrong), core::Error) << wrong;
  }
  EXPECT_NO_THROW((void)make_device("exoskeleton:feed-forward=0.5", 1000.0));
  EXPECT_THROW((void)make_device("exoskeleton:fast", 1000.0), core::Error);
}

TEST(ExoskeletonDevice, AFingerThatComesOffSaysSoAndCanBePutBack) {
  Laboratory laboratory(Parameters{.break_away_n = 4.0});
  laboratory.feel(core::viscous({.viscosity_pa_s = 30.0}));
  laboratory.stroke({.num_strokes = 1});
  EXPECT_NE(laboratory.state.attached, core::kAllAttached);
  EXPECT_EQ(laboratory.telemetry.value().fault, core::Fault::kNone);
  laboratory.exoskeleton.simulated_hand()->go_home();
  laboratory.exoskeleton.simulated_hand()->put_fingers_back();
  for (int i = 0; i < 2000; ++i) laboratory.tick();
  EXPECT_EQ(laboratory.state.attached, core::kAllAttached);
  EXPECT_EQ(laboratory.telemetry.value().fault, core::Fault::kNone);
}

TEST(ExoskeletonDevice, LooseFingersNeverBlowUpWithoutForce) {
  for (const int num_attached : {0, 1, 3}) {
    Parameters parameters;
    for (int point = num_attached; point < core::kNumContactPoints; ++point) {
      parameters.attached[point] = false;
    }
    Laboratory laboratory(parameters);
    laboratory.feel(core::viscous({.viscosity_pa_s = 30.0}));
    laboratory.stroke({.num_strokes = 1});
    EXPECT_EQ(laboratory.telemetry.value().fault, core::Fault::kNone) << num_attached;
    for (const Vector3d& velocity : laboratory.state.tip_velocity_m_per_s) {
      EXPECT_LT(velocity.norm(), 1.5) << num_attached;
    }
  }
}

TEST(ExoskeletonDevice, ATickTakesNothingFromTheHeap) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  Laboratory laboratory;
  laboratory.feel(core::viscous({.viscosity_pa_s = 4.0}));
  laboratory.exoskeleton.simulated_hand()->begin_strokes({}, core::RandomStream(1, "stroke"));
  laboratory.tick();
  const test_support::AllocationCounter counter;
  for (int i = 0; i < 300; ++i) laboratory.tick();
  EXPECT_EQ(counter.allocations(), 0U);
  EXPECT_EQ(counter.frees(), 0U);
}

TEST(ExoskeletonDevice, NamesTheParameterItRejects) {
  EXPECT_THROW(ExoskeletonDevice(Parameters{.rate_hz = kNan}), core::Error);
  EXPECT_THROW(ExoskeletonDevice(Parameters{.rate_hz = 1e6}), core::Error);
  EXPECT_THROW(ExoskeletonDevice(Parameters{.velocity_cutoff_hz = 0.0}), core::Error);
  EXPECT_THROW(ExoskeletonDevice(Parameters{.break_away_n = kNan}), core::Error);
  EXPECT_THROW(ExoskeletonDevice(Parameters{.extra_delay_s = -0.001}), core::Error);
  EXPECT_THROW(ExoskeletonDevice(Parameters{.extra_delay_s = kNan}), core::Error);
  EXPECT_THROW(ExoskeletonDevice(Parameters{.max_total_force_n = kNan}), core::Error);
  EXPECT_THROW(ExoskeletonDevice(Parameters{.max_force_per_point_n = 0.0}), core::Error);
  EXPECT_THROW(ExoskeletonDevice(Parameters{.arm = {.home_z_m = kNan}}), core::Error);
}

}  // namespace exoskeleton_device_test
}  // namespace jnd::device
