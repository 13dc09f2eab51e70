// Breaks every number that comes into the loop, in every way and at every phase, and judges
// what the device received.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "haptic_loop_scene.h"
#include "support/sanitizer.h"

namespace jnd::device {
namespace haptic_loop_bad_input_test {

using core::Fault;

constexpr double kDenormal = std::numeric_limits<double>::denorm_min();
const std::array kBroken = {std::numeric_limits<double>::quiet_NaN(),
                            std::numeric_limits<double>::infinity(),
                            -std::numeric_limits<double>::infinity(),
                            kDenormal,
                            1e308,
                            -1e308};

struct StateInput {
  std::string name;
  double* (*place)(core::HapticState& state, int index);
  int index;
};

/// The step from one broken input to the next.
constexpr std::size_t kStride = test_support::kIsSanitized ? 5 : 1;

std::vector<StateInput> state_inputs() {
  std::vector<StateInput> inputs;
  for (int i = 0; i < 3 * core::kNumContactPoints; ++i) {
    inputs.push_back({"tip position",
                      [](core::HapticState& state, int index) {
                        return &state.tip_position_m[index / 3][index % 3];
                      },
                      i});
    inputs.push_back({"tip velocity",
                      [](core::HapticState& state, int index) {
                        return &state.tip_velocity_m_per_s[index / 3][index % 3];
                      },
                      i});
  }
  for (int i = 0; i < 3; ++i) {
    inputs.push_back({"end effector",
                      [](core::HapticState& state, int index) {
                        return &state.end_effector_position_m[index];
                      },
                      i});
  }
  // The test takes one joint of the arm, one of a finger in the middle, and the last one.
  for (const int i : {0, 12, core::kNumJoints - 1}) {
    inputs.push_back(
        {"joint position",
         [](core::HapticState& state, int index) { return &state.joint_position_rad[index]; },
         i});
    inputs.push_back(
        {"joint torque",
         [](core::HapticState& state, int index) { return &state.joint_torque_n_m[index]; },
         i});
  }
  return inputs;
}

/// Runs one tick with this value in place of the measured one, and then restores the
/// measurement.
void tick_with(LoopScene& scene, const StateInput& input, double value) {
  const core::HapticState measured = scene.device.state;
  *input.place(scene.device.state, input.index) = value;
  scene.run(1);
  scene.device.state = measured;
  scene.device.state.device_time_ns += 1'000'000;
}

TEST(HapticLoopBadInput, NoBrokenMeasurementBecomesAForceAtAnyPhase) {
  const std::vector<StateInput> inputs = state_inputs();
  for (const Phase phase : kPhases) {
    for (const auto& attached : kAttachments) {
      for (std::size_t i = 0; i < inputs.size(); i += kStride) {
        const StateInput& input = inputs[i];
        for (const double value : kBroken) {
          SCOPED_TRACE(std::string(words(phase)) + ", " + input.name + ' ' +
                       std::to_string(input.index) + " = " + std::to_string(value));
          LoopScene scene(attached);
          scene.bring_to(phase);
          const core::PointVectors before = scene.last_received();
          tick_with(scene, input, value);
          const core::PointVectors struck = scene.last_received();
          ASSERT_TRUE(is_safe(struck, before, attached));
          if (!std::isfinite(value)) {
            ASSERT_EQ(sum_of_magnitudes_n(struck), 0.0);
            ASSERT_EQ(scene.fault(), Fault::kNonFiniteState);
          }
          if (value == kDenormal && phase != Phase::kFirstTick &&
              input.name.starts_with("joint")) {
            ASSERT_GT(sum_of_magnitudes_n(struck), 0.0) << "the smallest number is a number";
          }
          core::PointVectors last = struck;
          for (int tick = 0; tick < 5; ++tick) {
            scene.run(1);
            ASSERT_TRUE(is_safe(scene.last_received(), last, attached));
            last = scene.last_received();
            if (!std::isfinite(value)) {
              ASSERT_EQ(sum_of_magnitudes_n(last), 0.0) << "latched";
            }
          }
        }
      }
    }
  }
}

TEST(HapticLoopBadInput, NoBrokenAmountBecomesAForceAtAnyPhase) {
  for (const Phase phase : kPhases) {
    for (const auto& attached : kAttachments) {
      for (std::size_t i = 0; i < core::kAmounts.size(); i += kStride) {
        for (const double value : kBroken) {
          for (const double ramp_s : {0.0, 0.05}) {
            SCOPED_TRACE(std::string(words(phase)) + ", amount " + std::to_string(i) + " = " +
                         std::to_string(value));
            LoopScene scene(attached);
            scene.bring_to(phase);
            scene.command.medium.*core::kAmounts[i] = value;
            scene.command.ramp_s = ramp_s;
            scene.publish();
            core::PointVectors last = scene.last_received();
            for (int tick = 0; tick < 10; ++tick) {
              scene.run(1);
              ASSERT_TRUE(is_safe(scene.last_received(), last, attached));
              last = scene.last_received();
              if (!std::isfinite(value)) {
                ASSERT_EQ(sum_of_magnitudes_n(last), 0.0);
              }
            }
            if (!std::isfinite(value)) {
              ASSERT_EQ(scene.fault(), Fault::kNonFiniteForce);
            }
          }
        }
      }
    }
  }
}

TEST(HapticLoopBadInput, FiniteAmountsWhoseForceIsNoneAreAFaultToo) {
  for (const Phase phase : kPhases) {
    for (const auto& attached : kAttachments) {
      LoopScene scene(attached);
      scene.bring_to(phase);
      for (const auto amount : core::kAmounts) scene.command.medium.*amount = 1e308;
      scene.command.ramp_s = 0.0;
      scene.publish();
      scene.device.move_all({3.0, 0.0, -2.0});
      core::PointVectors last = scene.last_received();
      for (int tick = 0; tick < 100; ++tick) {
        scene.run(1);
        ASSERT_TRUE(is_safe(scene.last_received(), last, attached)) << words(phase);
        last = scene.last_received();
      }
      EXPECT_EQ(scene.fault(), Fault::kNonFiniteForce) << words(phase);
      EXPECT_EQ(sum_of_magnitudes_n(last), 0.0);
    }
  }
}

TEST(HapticLoopBadInput, NoBrokenRampOrContainerBecomesAStepAtAnyPhase) {
  const auto strike = [](core::HapticCommand& command, int which, double value) {
    double* const places[] = {&command.ramp_s,
                              &command.immersion.radius_m,
                              &command.immersion.depth_m,
                              &command.immersion.origin_x_m,
                              &command.immersion.origin_y_m,
                              &command.immersion.origin_z_m};
    *places[which] = value;
  };
  for (const Phase phase : kPhases) {
    for (const auto& attached : kAttachments) {
      for (int which = 0; which < 6; ++which) {
        for (const double value : kBroken) {
          SCOPED_TRACE(std::string(words(phase)) + ", " + std::to_string(which) + " = " +
                       std::to_string(value));
          LoopScene scene(attached);
          scene.command.medium += core::container({.stiffness_n_per_m = 500.0});
          scene.command.immersion.radius_m = 0.2;
          scene.command.immersion.depth_m = 0.2;
          scene.publish();
          scene.bring_to(phase);
          strike(scene.command, which, value);
          scene.publish();
          core::PointVectors last = scene.last_received();
          for (int tick = 0; tick < 10; ++tick) {
            scene.run(1);
            ASSERT_TRUE(is_safe(scene.last_received(), last, attached));
            last = scene.last_received();
          }
        }
      }
    }
  }
}

TEST(HapticLoopBadInput, ABrokenAmountNeverEntersTheRamp) {
  LoopScene scene;
  scene.bring_to(Phase::kInContact);
  const core::MediumAmounts sound = scene.command.medium;
  scene.command.medium.damping_n_s_per_m = std::numeric_limits<double>::infinity();
  scene.publish();
  scene.run(100);
  scene.loop.rearm();
  scene.run(5);
  EXPECT_EQ(scene.fault(), Fault::kNonFiniteForce) << "as long as it is commanded";
  scene.command.medium = sound;
  scene.publish();
  scene.run(1);
  EXPECT_EQ(sum_of_magnitudes_n(scene.last_received()), 0.0) << "latched";
  scene.loop.rearm();
  scene.run(600);
  EXPECT_EQ(scene.fault(), Fault::kNone);
  EXPECT_GT(sum_of_magnitudes_n(scene.last_received()), 0.5);
}

TEST(HapticLoopBadInput, ForceOnAPointThatComesOffIsZeroInTheSameTickAtEveryPhase) {
  for (const Phase phase : kPhases) {
    for (const auto& attached : kAttachments) {
      for (int point = 0; point < core::kNumContactPoints; ++point) {
        if (!attached[point]) continue;
        SCOPED_TRACE(std::string(words(phase)) + ", point " + std::to_string(point));
        LoopScene scene(attached);
        scene.bring_to(phase);
        scene.device.state.attached[point] = false;
        // The finger has no hand, so its 30 g are thrown about.
        scene.device.state.tip_velocity_m_per_s[point] = {2.0, -1.0, -3.0};
        core::PointVectors last = scene.last_received();
        for (int tick = 0; tick < 20; ++tick) {
          scene.run(1);
          ASSERT_EQ(scene.last_received()[point], Eigen::Vector3d::Zero()) << tick;
          ASSERT_TRUE(is_safe(scene.last_received(), last, scene.device.state.attached));
          last = scene.last_received();
        }
      }
    }
  }
}

TEST(HapticLoopBadInput, APointThatIsHeldAgainFeelsNoStep) {
  for (const Phase phase : {Phase::kInRamp, Phase::kInContact, Phase::kAfterRearm}) {
    for (const Eigen::Vector3d& velocity :
         {Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(0.3, 0.0, 0.0)}) {
      LoopScene moving;
      moving.bring_to(phase);
      moving.device.move_all(velocity);
      moving.device.state.attached[0] = false;
      moving.run(20);
      moving.device.state.attached[0] = true;
      double last_n = 0.0;
      for (int tick = 0; tick < 300; ++tick) {
        moving.run(1);
        const double now_n = moving.last_received()[0].norm();
        ASSERT_LT(std::abs(now_n - last_n), 0.05) << words(phase) << ' ' << tick;
        last_n = now_n;
      }
    }
  }
}

TEST(HapticLoopBadInput, AMagnetThatChattersDoesNotKnock) {
  LoopScene scene;
  scene.bring_to(Phase::kInContact);
  scene.device.move_all({0.3, 0.0, 0.0});
  for (int tick = 0; tick < 200; ++tick) {
    scene.device.state.attached[0] = tick % 2 == 1;
    scene.run(1);
    ASSERT_LT(scene.last_received()[0].norm(), 0.02) << tick;
  }
  scene.published_telemetry.fetch();
  EXPECT_EQ(scene.published_telemetry.value().num_detachments[0], 100U);
  EXPECT_EQ(scene.published_telemetry.value().num_detachments[1], 0U);
}

}  // namespace haptic_loop_bad_input_test
}  // namespace jnd::device
