#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "device/plugin/driver_library.h"
#include "device/plugin/jnd_device.h"
#include "force_dimension_fixture.h"

// Tests what goes wrong with a device of Force Dimension. The force has to end at the twin of
// its library, which judges each force that it is given (`ForceDimensionTest::TearDown`).

namespace jnd::device {
namespace force_dimension_faults_test {

using core::Fault;

class ForceDimensionFaultsTest : public ForceDimensionTest {
 protected:
  /// Runs until the twin has got a force in the middle of a stroke.
  static void push(HapticDevice& device, StrokedFluid& fluid) {
    const auto is_in_a_stroke = [&] {
      return force_at_twin_n() >= 0.2 && std::abs(fluid.told().hand_velocity_m_per_s[0]) > 0.1;
    };
    int num_late = 0;
    for (int i = 0; i < 400 && !is_in_a_stroke(); ++i) {
      const Fault found = fluid.run(10);
      if (was_late(found, fluid) && ++num_late <= 5) {
        arm(device, fluid);
        continue;
      }
      ASSERT_EQ(found, Fault::kNone) << core::name(found) << ": " << fluid.words();
    }
    ASSERT_GE(force_at_twin_n(), 0.2)
        << core::name(fluid.told().fault) << ", the loop sends "
        << fluid.told().total_force_n[0] << " N at " << fluid.told().hand_velocity_m_per_s[0]
        << " m/s, the twin is at " << page().position_m[1] << " m, on " << page().is_on;
  }
  /// Arms as a person does, who tries again where a busy machine was late with a reading.
  static void arm(HapticDevice& device, StrokedFluid& fluid) {
    Fault found = Fault::kLinkLost;
    for (int i = 0; i < 20 && was_late(found, fluid); ++i) {
      ASSERT_TRUE(comes_to([&] {
        (void)fluid.run(1);
        return device.may_arm();
      }));
      fluid.loop().rearm(fluid.told().num_faults);
      found = fluid.run(900);
    }
    ASSERT_EQ(found, Fault::kNone) << core::name(found) << ": " << fluid.words();
  }
  /// Whether a busy machine kept the driver's process waiting. Then the driver itself has no
  /// complaint: it says in words what the library refused.
  static bool was_late(Fault found, const StrokedFluid& fluid) {
    return found == Fault::kLinkLost ||
           (found == Fault::kDeviceReadFailed && fluid.words().empty());
  }
  /// Expects that the force is gone, and that none comes while the loop goes on.
  static void expect_no_force(StrokedFluid& fluid) {
    EXPECT_TRUE(comes_to([&] {
      (void)fluid.run(1);
      return force_at_twin_n() == 0.0;
    }));
    for (int i = 0; i < 50; ++i) {
      fluid.go_on(1);
      EXPECT_EQ(force_at_twin_n(), 0.0);
    }
  }
  struct Expected {
    int trouble;
    std::vector<Fault> faults;
    std::string words;  ///< What the device says; "": nothing.
  };
};

/// The driver alone, without the process and the checks that jnd puts around it.
class DriverAlone {
 public:
  explicit DriverAlone(const std::filesystem::path& driver, const std::string& options)
      : library_(driver) {
    if (library_.open(options.c_str(), 1000.0, &device_) != JND_DEVICE_OK) {
      ADD_FAILURE() << library_.error(nullptr);
    }
  }
  ~DriverAlone() {
    if (device_ != nullptr) library_.close(device_);
  }
  DriverAlone(const DriverAlone&) = delete;
  DriverAlone& operator=(const DriverAlone&) = delete;

  [[nodiscard]] bool is_open() const { return device_ != nullptr; }
  int read() {
    state_ = {};
    state_.struct_size = sizeof state_;
    return library_.read(device_, &state_);
  }
  int write(double x_n) {
    jnd_device_command command{};
    command.struct_size = sizeof command;
    command.write_number = ++num_writes_;
    command.force_on_hand_n[0][0] = x_n;
    return library_.write(device_, &command);
  }
  void halt() { library_.halt(device_); }
  std::string words() { return library_.error(device_); }
  const jnd_device_state& state() const { return state_; }

 private:
  DriverLibrary library_;
  jnd_device* device_ = nullptr;
  jnd_device_state state_{};
  std::uint64_t num_writes_ = 0;
};

TEST_F(ForceDimensionFaultsTest, EachTroubleInALoopEndsTheForceAndIsNamed) {
  const std::vector<Fault> read_fails = {Fault::kDeviceReadFailed};
  const std::vector<Fault> is_late = {Fault::kStaleSample, Fault::kDeviceReadFailed};
  const std::vector<Expected> all = {
      {TWIN_UNPLUGGED, read_fails, "(communication error); look at"},
      {TWIN_READS_FAIL, read_fails,
       "it does not tell where it is (communication error); look at cable and power"},
      {TWIN_STATUS_FAILS, read_fails, "it does not tell how it is (communication error)"},
      {TWIN_VELOCITIES_FAIL, read_fails, "it does not tell its velocity (communication error)"},
      {TWIN_NAN_POSITION, read_fails, "it tells a position that is no number"},
      {TWIN_NAN_VELOCITY, read_fails, "it tells a velocity that is no number"},
      {TWIN_LOST_CALIBRATION, read_fails, "it has lost its calibration; open it anew"},
      {TWIN_CONTROLLER_ERROR, read_fails, "its controller reports an error; switch it off"},
      {TWIN_WRITES_FAIL, {Fault::kDeviceWriteFailed}, "it did not take the force"},
      {TWIN_ZEROS_FAIL, {Fault::kDeviceWriteFailed}, ""},
      {TWIN_BUTTON, {Fault::kNotEnabled}, ""},
      {TWIN_TOO_FAST, {Fault::kNotEnabled}, ""},
      {TWIN_TIME_GUARD, is_late, ""},
      {TWIN_STALE, is_late, ""},
      {TWIN_SLOW_READ, is_late, ""},
      {TWIN_STUCK_READ, is_late, ""},
  };
  for (const Expected& expected : all) {
    SetUp();
    page().slow_ms = 300;
    const auto device = opened(argument());
    StrokedFluid fluid(*device);
    push(*device, fluid);
    page().trouble = expected.trouble;
    const Fault found = fluid.run(8000);
    EXPECT_TRUE(std::ranges::find(expected.faults, found) != expected.faults.end())
        << expected.trouble << ": " << core::name(found);
    expect_no_force(fluid);
    if (!expected.words.empty()) {
      EXPECT_NE(device->words_of_fault().find(expected.words), std::string::npos)
          << expected.trouble << ": " << device->words_of_fault();
    }
    EXPECT_EQ(page().num_unsafe, 0)
        << "trouble " << expected.trouble << ", act " << page().first_unsafe;
  }
}

TEST_F(ForceDimensionFaultsTest, OneWithAWristAndAGripperIsHeldToTheSame) {
  page().type = 35;
  page().has_wrist = page().has_gripper = 1;
  const auto device = opened(argument());
  StrokedFluid fluid(*device);
  push(*device, fluid);
  page().trouble = TWIN_BROKEN_ROTATION;
  EXPECT_EQ(fluid.run(3000), Fault::kDeviceReadFailed);
  EXPECT_EQ(device->words_of_fault(), "it tells an orientation that is none");
  expect_no_force(fluid);
  page().trouble = TWIN_IS_WELL;
  page().gap_m = std::nan("");
  EXPECT_TRUE(comes_to([&] {
    (void)fluid.run(1);
    return device->words_of_fault().starts_with("it does not tell how far its gripper is open");
  }));
}

/// When the device's cable is pulled, whatever is under way fails, and the controller ends the
/// force.
TEST_F(ForceDimensionFaultsTest, ACablePulledInAnyPhaseEndsTheForce) {
  for (const int phase : {TWIN_IN_READ, TWIN_IN_WRITE, TWIN_IN_HALT, TWIN_IN_CLOSE}) {
    SetUp();
    auto device = opened(argument());
    StrokedFluid fluid(*device);
    push(*device, fluid);
    page().unplugged_in = phase;
    if (phase == TWIN_IN_HALT) device->halt();
    if (phase != TWIN_IN_CLOSE) {
      const Fault found = fluid.run(3000);
      EXPECT_NE(found, Fault::kNone) << phase;
      expect_no_force(fluid);
      EXPECT_EQ(page().num_watchdog_ends, 1) << phase;
      EXPECT_FALSE(device->may_arm()) << phase;
      EXPECT_NE(device->words_of_fault(), "") << phase;
    }
    const auto begin = std::chrono::steady_clock::now();
    device.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(2)) << phase;
    EXPECT_EQ(force_at_twin_n(), 0.0) << phase;
    EXPECT_EQ(page().trouble, TWIN_UNPLUGGED) << phase;
    EXPECT_EQ(page().num_unsafe, 0) << phase << ", act " << page().first_unsafe;
    // Connecting the device again is another opening.
    page().unplugged_in = TWIN_NEVER;
    page().trouble = TWIN_IS_WELL;
    EXPECT_EQ(why_not_with(), "") << phase;
  }
}

TEST_F(ForceDimensionFaultsTest, AfterAPassingTroubleAPersonArmsAndTheForceIsBack) {
  const auto device = opened(argument());
  StrokedFluid fluid(*device);
  for (const int trouble : {TWIN_READS_FAIL, TWIN_WRITES_FAIL, TWIN_ZEROS_FAIL}) {
    push(*device, fluid);
    page().trouble = trouble;
    EXPECT_NE(fluid.run(3000), Fault::kNone) << trouble;
    expect_no_force(fluid);
    page().trouble = TWIN_IS_WELL;
    arm(*device, fluid);
  }
  push(*device, fluid);
}

TEST_F(ForceDimensionFaultsTest, WhatAPersonSwitchesOffNoProgramSwitchesOn) {
  const auto device = opened(argument());
  StrokedFluid fluid(*device);
  push(*device, fluid);
  page().trouble = TWIN_BUTTON;
  EXPECT_EQ(fluid.run(3000), Fault::kNotEnabled);
  expect_no_force(fluid);
  page().trouble = TWIN_IS_WELL;
  for (int i = 0; i < 10; ++i) {
    fluid.loop().rearm(fluid.told().num_faults);
    fluid.go_on(30);
    EXPECT_TRUE(core::is_failure(fluid.told().fault));
    EXPECT_EQ(page().is_on, 0);
  }
  page().trouble = TWIN_BUTTON_AGAIN;
  ASSERT_TRUE(comes_to([] { return page().is_on == 1; }));
  fluid.go_on(50);
  EXPECT_EQ(force_at_twin_n(), 0.0) << "nobody has armed it";
  arm(*device, fluid);
  push(*device, fluid);
}

TEST_F(ForceDimensionFaultsTest, AfterTheControllersWatchdogZerosSwitchItOnAndAPersonArms) {
  page().watchdog_step_s = 1.25e-3;
  const auto device = opened(argument());
  StrokedFluid fluid(*device);
  push(*device, fluid);
  const int num_before = page().num_watchdog_ends;
  pause_ms(400);  // Nobody writes during this pause.
  EXPECT_EQ(force_at_twin_n(), 0.0);
  EXPECT_GT(page().num_watchdog_ends, num_before);
  EXPECT_TRUE(comes_to([&] { return fluid.run(1) != Fault::kNone; }));
  EXPECT_TRUE(comes_to([&] {
    (void)fluid.run(1);
    return page().is_on == 1;
  }));
  expect_no_force(fluid);
  arm(*device, fluid);
  push(*device, fluid);
}

TEST_F(ForceDimensionFaultsTest, ForcesOfARealOneEndByThemselvesWhenCommandsDo) {
  page().is_virtual = 0;
  page().watchdog_step_s = 10.0;  // The host has to end the force, not the controller.
  const auto device = opened(argument());
  core::HapticState state;
  ASSERT_TRUE(comes_to([&] {
    (void)device->read(state);
    // On a busy machine the program may have been silent for too long already.
    if (!device->write(pushed(1.0))) (void)device->write(core::zero_vectors());
    return force_at_twin_n() == 1.0;
  }));
  EXPECT_TRUE(comes_to([] { return force_at_twin_n() == 0.0; }));
  EXPECT_GE(page().num_zeros_of_others, 1);
  EXPECT_EQ(page().is_on, 1) << "it goes on to carry its weight";
}

/// The library keeps its lock, so that no halt of ours gets through.
TEST_F(ForceDimensionFaultsTest, WhereTheLibraryIsStuckTheControllerEndsTheForce) {
  page().is_virtual = 0;
  page().watchdog_step_s = 125e-6;
  const auto device = opened(argument());
  core::HapticState state;
  ASSERT_TRUE(comes_to([&] {
    (void)device->read(state);
    if (!device->write(pushed(1.0))) (void)device->write(core::zero_vectors());
    return force_at_twin_n() == 1.0;
  }));
  page().trouble = TWIN_STUCK_READ;
  (void)device->read(state);
  device->halt();
  // On a busy machine the host may have ended the force before the library was stuck.
  EXPECT_TRUE(comes_to([] { return page().num_watchdog_ends >= 1; }));
  EXPECT_EQ(force_at_twin_n(), 0.0);
}

TEST_F(ForceDimensionFaultsTest, AHaltEndsTheForceAtOnceAndZerosAloneBringItBack) {
  const auto device = opened(argument());
  core::HapticState state;
  const auto becomes = [&](double force_n, double asked_n) {
    return comes_to([&] {
      (void)device->read(state);
      // On a busy machine the program may have been silent for too long in the meantime.
      if (!device->write(pushed(asked_n))) (void)device->write(core::zero_vectors());
      return force_at_twin_n() == force_n;
    });
  };
  ASSERT_TRUE(becomes(1.0, 1.0));
  device->halt();
  ASSERT_TRUE(comes_to([] { return force_at_twin_n() == 0.0; }));
  for (int i = 0; i < 20; ++i) {
    (void)device->write(pushed(1.0));
    (void)device->read(state);
    EXPECT_EQ(force_at_twin_n(), 0.0);
    pause_ms(1);
  }
  ASSERT_TRUE(becomes(0.0, 0.0));
  (void)device->write(pushed(0.0));
  pause_ms(20);
  EXPECT_TRUE(becomes(1.0, 1.0));
}

TEST_F(ForceDimensionFaultsTest, SaturationAndTheTimeGuardAreNoErrors) {
  {
    const auto device = opened(argument());
    StrokedFluid fluid(*device);
    page().trouble = TWIN_SATURATED;
    push(*device, fluid);
    EXPECT_EQ(fluid.run(200), Fault::kNone);
    page().trouble = TWIN_IS_WELL;
  }
  // The driver asks twice as often as the library asks the device, so that half of the
  // positions are the one before.
  DriverAlone alone(driver(), "library=" + twin().string() + ",time_guard_us=1000");
  ASSERT_TRUE(alone.is_open());
  int num_new = 0, num_old = 0;
  for (int i = 0; i < 100; ++i) {
    const int result = alone.read();
    ASSERT_NE(result, JND_DEVICE_FAILED) << alone.words();
    ++(result == JND_DEVICE_OK ? num_new : num_old);
  }
  EXPECT_GE(num_new, 1);
  EXPECT_GE(num_old, 50);
}

TEST_F(ForceDimensionFaultsTest, TheDriverAloneTakesNoForceThatMustNotBe) {
  DriverAlone alone(driver(), "library=" + twin().string() + ",max_force_n=5");
  ASSERT_TRUE(alone.is_open());
  page().limit_n = 5.0;
  const auto refuses = [&](double force_n, const char* why) {
    EXPECT_EQ(alone.write(force_n), JND_DEVICE_FAILED) << why;
    EXPECT_NE(alone.words(), "") << why;
    EXPECT_EQ(force_at_twin_n(), 0.0) << why;
    EXPECT_EQ(alone.write(1.0), JND_DEVICE_FAILED) << why << ", and zeros did not come";
    EXPECT_EQ(force_at_twin_n(), 0.0) << why;
    EXPECT_EQ(alone.write(0.0), JND_DEVICE_OK) << why << ": " << alone.words();
    EXPECT_EQ(alone.write(1.0), JND_DEVICE_OK) << why << ": " << alone.words();
    EXPECT_EQ(force_at_twin_n(), 1.0) << why;
  };
  ASSERT_EQ(alone.read(), JND_DEVICE_OK) << alone.words();
  EXPECT_EQ(alone.write(1.0), JND_DEVICE_OK) << "the first, whatever it is";
  EXPECT_EQ(force_at_twin_n(), 1.0);
  refuses(5.1, "above its limit");
  refuses(std::nan(""), "no number");
  alone.halt();
  EXPECT_EQ(force_at_twin_n(), 0.0);
  refuses(1.0, "after a halt");
  page().trouble = TWIN_WRITES_FAIL;
  EXPECT_EQ(alone.write(2.0), JND_DEVICE_FAILED);
  EXPECT_EQ(force_at_twin_n(), 0.0) << "the one before does not stand";
  page().trouble = TWIN_IS_WELL;
  refuses(1.0, "after a write that failed");
  // After a read that failed, zeros are not enough: nobody knows where the hand is.
  page().trouble = TWIN_READS_FAIL;
  EXPECT_EQ(alone.read(), JND_DEVICE_FAILED);
  EXPECT_EQ(force_at_twin_n(), 0.0);
  EXPECT_EQ(alone.write(1.0), JND_DEVICE_FAILED);
  EXPECT_EQ(alone.write(0.0), JND_DEVICE_OK);
  EXPECT_EQ(alone.write(1.0), JND_DEVICE_FAILED);
  page().trouble = TWIN_IS_WELL;
  pause_ms(30);
  ASSERT_TRUE(comes_to([&] { return alone.read() == JND_DEVICE_OK; })) << alone.words();
  EXPECT_EQ(alone.write(0.0), JND_DEVICE_OK);
  EXPECT_EQ(alone.write(1.0), JND_DEVICE_OK) << alone.words();
}

TEST_F(ForceDimensionFaultsTest, WhatActedIsWhatTheMotorsWereTold) {
  DriverAlone alone(driver(), "library=" + twin().string());
  ASSERT_TRUE(alone.is_open());
  const auto acted_n = [&] {
    EXPECT_TRUE(comes_to([&] { return alone.read() == JND_DEVICE_OK; })) << alone.words();
    return alone.state().acted_n[0][0];
  };
  EXPECT_EQ(acted_n(), 0.0);
  EXPECT_EQ(alone.write(2.0), JND_DEVICE_OK);
  EXPECT_EQ(acted_n(), 2.0);
  alone.halt();
  EXPECT_EQ(acted_n(), 0.0);
  EXPECT_EQ(alone.write(0.0), JND_DEVICE_OK);
  EXPECT_EQ(alone.write(1.5), JND_DEVICE_OK);
  EXPECT_EQ(acted_n(), 1.5);
  page().trouble = TWIN_BUTTON;
  ASSERT_TRUE(comes_to([] { return page().is_on == 0; }));
  EXPECT_TRUE(
      comes_to([&] { return alone.read() == JND_DEVICE_OK && alone.state().enabled == 0; }));
  EXPECT_EQ(acted_n(), 0.0);
}

TEST_F(ForceDimensionFaultsTest, AfterAPauseItsVelocityIsTheWayOverThePause) {
  page().held_m[1] = 0.0;
  page().stroke_m = 0.0;
  DriverAlone alone(driver(), "library=" + twin().string());
  ASSERT_TRUE(alone.is_open());
  const auto velocity_m_per_s = [&] {
    pause_ms(100);
    EXPECT_EQ(alone.read(), JND_DEVICE_OK) << alone.words();
    return alone.state().velocity_m_per_s[0][0];
  };
  EXPECT_NEAR(velocity_m_per_s(), 0.0, 0.01) << "the first read comes after one";
  page().held_m[1] = 0.02;  // The device's y is our x.
  const double found_m_per_s = velocity_m_per_s();
  EXPECT_GT(found_m_per_s, 0.005);
  EXPECT_LT(found_m_per_s, 0.21) << "20 mm in 100 ms";
}

/// The halt comes while a force is on its way to the device.
TEST_F(ForceDimensionFaultsTest, NoForceStandsAfterAHaltWheneverItComes) {
  DriverAlone alone(driver(), "library=" + twin().string());
  ASSERT_TRUE(alone.is_open());
  ASSERT_EQ(alone.read(), JND_DEVICE_OK);
  page().slow_ms = 4;
  page().trouble = TWIN_SLOW_WRITE;
  constexpr int kNumRounds = 60;
  std::atomic<int> round{0}, num_halts{0};
  // It halts once in each round, a little later each time.
  std::thread halting([&] {
    for (int i = 1; i <= kNumRounds; ++i) {
      while (round < i) std::this_thread::yield();
      std::this_thread::sleep_for(std::chrono::microseconds(100 * (i % 50)));
      alone.halt();
      num_halts = i;
    }
  });
  int num_taken = 0;
  for (int i = 1; i <= kNumRounds; ++i) {
    EXPECT_EQ(alone.write(0.0), JND_DEVICE_OK);
    round = i;
    num_taken += alone.write(1.0) == JND_DEVICE_OK ? 1 : 0;
    while (num_halts < i) pause_ms(1);
    pause_ms(10);  // This is longer than a force may stand.
    EXPECT_EQ(force_at_twin_n(), 0.0) << "round " << i;
  }
  halting.join();
  EXPECT_GT(num_taken, kNumRounds / 4);
  EXPECT_GT(page().num_forces, kNumRounds / 4);
  EXPECT_GE(page().num_zeros_of_others, kNumRounds);
}

}  // namespace force_dimension_faults_test
}  // namespace jnd::device
