#include "device/check/driver_check.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <deque>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "device/lumped_hand_device.h"

namespace jnd::device {
namespace driver_check_test {

/// A simulated hand whose driver breaks one rule.
class WrongDevice final : public HapticDevice {
 public:
  explicit WrongDevice(std::string wrong, bool has_own_clock = false)
      : wrong_(std::move(wrong)), has_own_clock_(has_own_clock) {}

  [[nodiscard]] std::string_view name() const noexcept override { return "wrong"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    DeviceCapabilities can = hand_.capabilities();
    can.share_ratio = core::area_shares_of_first(2);
    can.tells_acting_force = true;
    can.own_mass_kg = 1.0;
    can.simulated = wrong_ != "real" && wrong_ != "blind";
    can.has_own_clock = has_own_clock_;
    if (wrong_ == "description") can.workspace.half_width_y_m = 400.0;
    return can;
  }
  void open() override {
    if (++num_opened_ > 1 && wrong_ == "reopens") throw core::Error("the port is taken");
    if (wrong_ == "opens") throw core::Error("the cable is out");
    hand_.open();
  }
  [[nodiscard]] bool read(core::HapticState& state) noexcept override {
    if (!hand_.read(state)) return false;
    ++num_reads_;
    if (wrong_ == "no_first_sample" && num_reads_ == 1) return false;
    if (wrong_ == "says_why" && num_reads_ > 600) return false;
    if (wrong_ == "blind" && num_reads_ > 2400) return false;
    if (wrong_ == "slow_read") std::this_thread::sleep_for(std::chrono::microseconds(700));
    if (wrong_ == "pace" && num_reads_ % 20 == 0) return false;
    if (wrong_ == "time") state.device_time_ns += state.device_time_ns / 10;
    for (auto& at : state.tip_position_m) at *= wrong_ == "units" ? 1000.0 : 1.0;
    for (auto& speed : state.tip_velocity_m_per_s) speed *= wrong_ == "velocity" ? 0.001 : 1.0;
    if (strokes_) stroke(state);
    // A low-pass of first order at 4 Hz.
    for (std::size_t i = 0; i < 5; ++i) {
      slow_m_per_s_[i] += (state.tip_velocity_m_per_s[i] - slow_m_per_s_[i]) / 41.0;
      if (wrong_ == "slow_velocity") state.tip_velocity_m_per_s[i] = slow_m_per_s_[i];
    }
    state.attached = {true, true, false, false, false};
    state.attached[4] = wrong_ == "absent_points";
    state.acted_n = acted_n_;
    if (wrong_ == "acted") state.acted_n[0] *= 0.5;
    // It tells of the force at once, and the hand feels it later.
    late_n_.push_back(given_n_);
    if (late_n_.size() > 40) late_n_.pop_front();
    if (wrong_ == "points") state.tip_position_m[1] += 0.02 * acted_n_[0];
    // What it was told acts a while later, by its own clock.
    if (has_own_clock_ && Clock::now() - told_at_ < std::chrono::milliseconds(3)) {
      state.acted_n = core::zero_vectors();
    }
    return true;
  }
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
    largest_n_ = std::max(largest_n_, force_on_hand_n[0].norm());
    core::PointVectors given_n = wrong_ == "latches" ? core::zero_vectors() : force_on_hand_n;
    const double most_n = capabilities().max_force_per_point_n;
    if (wrong_ != "limits" && given_n[0].norm() > most_n)
      given_n[0] *= most_n / given_n[0].norm();
    if (given_n[0].isZero(0.0)) is_halted_ = false;
    if (is_halted_) given_n = core::zero_vectors();
    if (acted_n_[0].isZero(0.0) && !given_n[0].isZero(0.0)) told_at_ = Clock::now();
    acted_n_ = given_n;
    if (wrong_ == "force_sign") given_n[0].y() = -given_n[0].y();
    if (wrong_ == "force_size") given_n[0] *= 4.4;
    given_n_ = given_n;
    return hand_.write(wrong_ == "delay" ? late_n_.front() : given_n);
  }
  void close() noexcept override { hand_.close(); }
  [[nodiscard]] std::string words_of_fault() const override {
    if (wrong_ == "no_first_sample") return "the first read found none";
    return wrong_ == "says_why" ? "gripper_m is not finite" : "";
  }
  [[nodiscard]] core::Fault fault() const noexcept override {
    return wrong_ == "latches" ? core::Fault::kOverVelocity : core::Fault::kNone;
  }
  void halt() noexcept override { is_halted_ = wrong_ != "halt"; }

  /// Its hand moves by itself along x.
  void stroke_by_itself() { strokes_ = true; }
  [[nodiscard]] double largest_n() const { return largest_n_; }

 private:
  using Clock = std::chrono::steady_clock;

  static void stroke(core::HapticState& state) {
    constexpr double kHalfWidth_m = 0.13, kTurn_rad_per_s = 3.14;
    const double turn_rad = kTurn_rad_per_s * 1e-9 * static_cast<double>(state.device_time_ns);
    for (auto& at : state.tip_position_m) at.x() -= kHalfWidth_m * std::cos(turn_rad);
    for (auto& speed : state.tip_velocity_m_per_s) {
      speed.x() += kHalfWidth_m * kTurn_rad_per_s * std::sin(turn_rad);
    }
  }

  std::string wrong_;
  bool strokes_ = false;
  bool has_own_clock_;
  Clock::time_point told_at_;
  LumpedHandDevice hand_{LumpedHandDevice::Parameters{}};
  core::PointVectors acted_n_ = core::zero_vectors(), slow_m_per_s_ = core::zero_vectors();
  core::PointVectors given_n_ = core::zero_vectors();
  std::deque<core::PointVectors> late_n_ = {core::zero_vectors()};
  bool is_halted_ = false;
  int num_opened_ = 0, num_reads_ = 0;
  double largest_n_ = 0.0;
};

struct Told {
  bool is_kept = false;
  std::map<std::string, RuleOutcome> outcomes;
};
Told told_of(HapticDevice& device, bool pushes = false) {
  Told told;
  told.is_kept = check_driver(device, {.pushes = pushes, .is_paced = false},
                              [&](const RuleOutcome& outcome) {
                                told.outcomes[std::string(outcome.rule.name)] = outcome;
                              });
  return told;
}

TEST(DriverCheck, AGoodDriverKeepsEveryRule) {
  WrongDevice device("nothing");
  const Told told = told_of(device);
  EXPECT_TRUE(told.is_kept);
  EXPECT_EQ(told.outcomes.size(), 16U);
  for (const auto& [rule, outcome] : told.outcomes) {
    EXPECT_EQ(outcome.verdict, RuleOutcome::Verdict::kPassed) << rule << ": " << outcome.found;
  }
}

class EachWrongDriver : public ::testing::TestWithParam<const char*> {};

TEST_P(EachWrongDriver, IsFoundByItsRuleAndByNoOther) {
  WrongDevice device(GetParam());
  const Told told = told_of(device);
  EXPECT_FALSE(told.is_kept);
  for (const auto& [rule, outcome] : told.outcomes) {
    EXPECT_EQ(outcome.verdict == RuleOutcome::Verdict::kFailed, rule == GetParam())
        << rule << ": " << outcome.found;
  }
}

// A driver of other units is tested apart: its positions and velocities agree, but it moves
// far.
INSTANTIATE_TEST_SUITE_P(Rules, EachWrongDriver,
                         ::testing::Values("opens", "pace", "time", "velocity", "description",
                                           "absent_points", "force_sign", "acted", "points",
                                           "force_size", "delay", "halt", "limits", "reopens"),
                         [](const auto& info) { return std::string(info.param); });

/// Of one with a clock of its own no force acts before its time goes on.
TEST(DriverCheck, TheLimitsOfADeviceWithAClockOfItsOwnAreTried) {
  WrongDevice good("nothing", /*has_own_clock=*/true);
  EXPECT_EQ(told_of(good).outcomes.at("limits").verdict, RuleOutcome::Verdict::kPassed);
  WrongDevice wrong("limits", /*has_own_clock=*/true);
  EXPECT_EQ(told_of(wrong).outcomes.at("limits").verdict, RuleOutcome::Verdict::kFailed);
}

TEST(DriverCheck, ASlowFilterOfTheVelocityIsFound) {
  WrongDevice device("slow_velocity");
  const Told told = told_of(device);
  EXPECT_EQ(told.outcomes.at("slow_velocity").verdict, RuleOutcome::Verdict::kFailed)
      << told.outcomes.at("slow_velocity").found;
}

/// The movement by itself is far larger than what a push adds, and often of an even speed.
TEST(DriverCheck, AHandThatMovesByItselfIsJudgedAsAnyOther) {
  WrongDevice good("nothing"), slow("slow_velocity"), other_way("force_sign");
  for (WrongDevice* device : {&good, &slow, &other_way}) device->stroke_by_itself();
  const Told kept = told_of(good);
  EXPECT_TRUE(kept.is_kept) << kept.outcomes.at("force_sign").found;
  EXPECT_EQ(kept.outcomes.at("slow_velocity").verdict, RuleOutcome::Verdict::kPassed);
  const Told late = told_of(slow);
  EXPECT_EQ(late.outcomes.at("slow_velocity").verdict, RuleOutcome::Verdict::kFailed)
      << late.outcomes.at("slow_velocity").found;
  EXPECT_EQ(told_of(other_way).outcomes.at("force_sign").verdict,
            RuleOutcome::Verdict::kFailed);
}

TEST(DriverCheck, WhatTheDriverSaysIsToldWithThePace) {
  WrongDevice device("says_why");
  const RuleOutcome pace = told_of(device).outcomes.at("pace");
  EXPECT_EQ(pace.verdict, RuleOutcome::Verdict::kFailed);
  EXPECT_NE(pace.found.find("The driver says: gripper_m is not finite"), std::string::npos)
      << pace.found;
  EXPECT_TRUE(pace.rule.advice.starts_with("Mend what the driver says")) << pace.rule.advice;
}

TEST(DriverCheck, AReadThatTakesMostOfATickIsFound) {
  WrongDevice device("slow_read");
  const RuleOutcome pace = told_of(device).outcomes.at("pace");
  EXPECT_EQ(pace.verdict, RuleOutcome::Verdict::kFailed) << pace.found;
}

TEST(DriverCheck, AFirstReadWithoutAMeasurementIsFound) {
  WrongDevice device("no_first_sample");
  const RuleOutcome opens = told_of(device).outcomes.at("opens");
  EXPECT_EQ(opens.verdict, RuleOutcome::Verdict::kFailed);
  EXPECT_EQ(opens.found, "the first read found none");
}

TEST(DriverCheck, WhatKeepsAForceAwayBeforeAHaltIsNamed) {
  WrongDevice device("latches");
  const RuleOutcome halt = told_of(device).outcomes.at("halt");
  EXPECT_EQ(halt.verdict, RuleOutcome::Verdict::kFailed);
  EXPECT_TRUE(halt.found.starts_with(
      "no force acted before the halt; the fault over_velocity keeps it away: "))
      << halt.found;
  EXPECT_TRUE(halt.rule.advice.starts_with("Tell in acted_n")) << halt.rule.advice;
}

TEST(DeviceRule, ASimulationThatLeavesWhatItTellsIsFound) {
  DeviceCapabilities can{.simulated = true, .max_speed_m_per_s = 0.1};
  can.workspace = {.half_width_x_m = 0.05, .half_width_y_m = 0.05, .half_width_z_m = 0.05};
  std::vector<core::HapticState> states(2);
  EXPECT_EQ(beyond_what_is_told(can, states), "");
  states[1].tip_position_m[0].y() = -0.14;
  states[1].tip_velocity_m_per_s[0].x() = 0.4;
  EXPECT_EQ(beyond_what_is_told(can, states),
            "it was 140 mm from the origin along y, and tells 50 mm, it moved at 0.40 m/s, and "
            "tells 0.10 m/s at most");
  can.simulated = false;
  EXPECT_EQ(beyond_what_is_told(can, states), "") << "it may be parked elsewhere";
}

TEST(DeviceRule, APushIsSeenOnlyAlongAnAxisOnWhichTheHandStandsStill) {
  std::vector<core::HapticState> states(300);
  for (std::size_t i = 0; i < states.size(); ++i) {
    states[i].tip_position_m[0].x() = 1e-4 * static_cast<double>(i);
    states[i].tip_position_m[0].y() = i < 150 ? 0.1 : 0.0;  // It had come to rest.
  }
  EXPECT_FALSE(stands_still(states, 0, 0));
  EXPECT_TRUE(stands_still(states, 0, 1));
  EXPECT_TRUE(stands_still(states, 0, 2));
  EXPECT_TRUE(stands_still({}, 0, 0));
}

TEST(DriverCheck, ADeviceWithAHandInItIsNeverPushed) {
  WrongDevice device("nothing");
  int num_prompts = 0;
  Told told;
  told.is_kept = check_driver(device,
                              {.pushes = true,
                               .is_paced = false,
                               .by_hand_step_s = 0.2,
                               .prompt = [&](const HandPrompt&) { ++num_prompts; }},
                              [&](const RuleOutcome& outcome) {
                                told.outcomes[std::string(outcome.rule.name)] = outcome;
                              });
  EXPECT_EQ(device.largest_n(), 0.0);
  EXPECT_EQ(told.outcomes.at("limits").verdict, RuleOutcome::Verdict::kSkipped);
  EXPECT_TRUE(told.outcomes.contains("mirrored_axes"));
}

TEST(DriverCheck, MillimetresAreFound) {
  WrongDevice device("units");
  EXPECT_EQ(told_of(device).outcomes.at("units").verdict, RuleOutcome::Verdict::kFailed);
}

TEST(DriverCheck, ARealDeviceIsNotPushedUnlessSomebodySaysSo) {
  WrongDevice device("real");
  const Told told = told_of(device);
  EXPECT_TRUE(told.is_kept);
  EXPECT_EQ(told.outcomes.at("halt").verdict, RuleOutcome::Verdict::kSkipped);
  EXPECT_EQ(device.largest_n(), 0.0);
}

TEST(DriverCheck, ARealDeviceIsNeverAskedForMoreThanAGentlePush) {
  WrongDevice device("real");
  const Told told = told_of(device, /*pushes=*/true);
  EXPECT_EQ(told.outcomes.at("halt").verdict, RuleOutcome::Verdict::kPassed);
  EXPECT_EQ(told.outcomes.at("limits").verdict, RuleOutcome::Verdict::kSkipped);
  EXPECT_NEAR(device.largest_n(), 0.5, 1e-12);
}

TEST(DriverCheck, ADeviceThatCannotBeReadAnyMoreIsNotPushed) {
  WrongDevice device("blind");  // It cannot be read from before the first push on.
  const Told told = told_of(device, /*pushes=*/true);
  EXPECT_EQ(told.outcomes.at("force_sign").verdict, RuleOutcome::Verdict::kFailed);
  EXPECT_EQ(told.outcomes.at("velocity").verdict, RuleOutcome::Verdict::kFailed);
  EXPECT_EQ(device.largest_n(), 0.0);
}

TEST(DriverCheck, WhoIsToldToStopLeavesNoForceAndADeviceThatIsClosed) {
  class CountingDevice final : public HapticDevice {
   public:
    [[nodiscard]] std::string_view name() const noexcept override { return "counting"; }
    [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
      return hand.capabilities();
    }
    void open() override { hand.open(); }
    [[nodiscard]] bool read(core::HapticState& state) noexcept override {
      ++num_reads;
      return hand.read(state);
    }
    [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
      last_n = force_on_hand_n;
      return hand.write(force_on_hand_n);
    }
    void close() noexcept override { ++num_closed; }
    void halt() noexcept override { hand.halt(); }
    LumpedHandDevice hand{LumpedHandDevice::Parameters{}};
    core::PointVectors last_n = core::zero_vectors();
    int num_reads = 0, num_closed = 0;
  } device;
  const auto is_pushed = [&device] { return !(device.last_n == core::zero_vectors()); };
  EXPECT_THROW(
      (void)check_driver(device, {.pushes = true, .is_paced = false, .is_cancelled = is_pushed},
                         [](const RuleOutcome&) {}),
      core::Error);
  EXPECT_FALSE(is_pushed());
  EXPECT_EQ(device.num_closed, 1);
  EXPECT_GT(device.num_reads, 0);
}

}  // namespace driver_check_test
}  // namespace jnd::device
