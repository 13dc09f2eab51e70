#include "device/check/hand_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/device_channels.h"
#include "device/check/velocity_lag.h"

namespace jnd::device {
namespace hand_check_test {

/// A person who does what the prompts say, with a device that has one mistake.
class Person {
 public:
  explicit Person(std::string wrong) : wrong_(std::move(wrong)) {
    can_.share_ratio = core::area_shares_of_first(5);
    can_.channels = core::kButtons | core::kGripper;
    can_.workspace = {0.25, 0.25, 0.25};
    if (wrong_ == "workspace") can_.workspace.half_width_y_m = 0.05;
    if (wrong_ == "large_workspace") can_.workspace.half_width_z_m = 1.0;
  }

  DeviceCapabilities can_;

  void obey(const HandPrompt& prompt) {
    steps_.push_back(std::string(prompt.step));
    last_ = prompt;
    if (step_ != prompt.step) since_s_ = 0.0;
    step_ = prompt.step;
  }

  std::vector<core::HapticState> watch(double duration_s) {
    std::vector<core::HapticState> all;
    for (int i = 0; i < std::lround(1000.0 * duration_s); ++i) all.push_back(next());
    return all;
  }

  [[nodiscard]] const std::vector<std::string>& steps() const { return steps_; }
  [[nodiscard]] const HandPrompt& last() const { return last_; }

 private:
  [[nodiscard]] Eigen::Vector3d goal_m() const {
    if (wrong_ == "lazy") return {0.0, 0.0, 0.0};
    if (step_ == "right") return {0.1, 0.0, 0.0};
    if (step_ == "away") return {0.0, 0.1, 0.0};
    if (step_ == "up") return {0.0, 0.0, 0.1};
    if (step_ != "workspace") return {0.0, 0.0, 0.0};
    Eigen::Vector3d end_m = Eigen::Vector3d::Zero();
    const int turn = static_cast<int>(since_s_ / 0.3) % 6;
    end_m[turn / 2] = turn % 2 == 0 ? 0.2 : -0.2;
    return end_m;
  }

  core::HapticState next() {
    constexpr double kStep_s = 0.001, kQuick = 25.0;
    since_s_ += kStep_s;
    time_s_ += kStep_s;
    velocity_m_per_s_ +=
        kStep_s * kQuick * (kQuick * (goal_m() - at_m_) - 2.0 * velocity_m_per_s_);
    at_m_ += kStep_s * velocity_m_per_s_;
    slow_m_per_s_ += kStep_s / 0.04 * (velocity_m_per_s_ - slow_m_per_s_);
    core::HapticState state;
    state.device_time_ns = std::llround(1e9 * time_s_);
    for (std::size_t point = 0; point < 5; ++point) {
      state.tip_position_m[point] = at_m_;
      state.tip_velocity_m_per_s[point] =
          wrong_ == "slow_velocity" ? slow_m_per_s_ : velocity_m_per_s_;
      if (wrong_ == "still") state.tip_velocity_m_per_s[point].z() += 0.05;
      if (wrong_ == "drift") state.tip_position_m[point].z() += 0.02 * time_s_;
    }
    const std::map<std::string, std::size_t> fingers = {
        {"thumb", 2}, {"index", 3}, {"middle", 4}};
    if (const auto finger = fingers.find(step_); finger != fingers.end()) {
      state.tip_position_m[finger->second].y() += 0.01 * std::sin(12.0 * since_s_);
    }
    if (step_ == "buttons" && since_s_ > 0.2 && since_s_ < 0.4) state.channels.buttons = 4;
    if (step_ == "gripper" && since_s_ < 0.5) state.channels.gripper_m = 0.08;
    spoil(state);
    return state;
  }

  void spoil(core::HapticState& state) const {
    if (wrong_ == "buttons") state.channels.buttons = 1;
    if (wrong_ == "gripper") state.channels.gripper_m = 0.08 - state.channels.gripper_m;
    if (wrong_ == "gripper_mm") state.channels.gripper_m *= 1000.0;
    if (wrong_ == "points_order") std::swap(state.tip_position_m[2], state.tip_position_m[3]);
    for (auto* vectors : {&state.tip_position_m, &state.tip_velocity_m_per_s}) {
      for (Eigen::Vector3d& vector : *vectors) {
        if (wrong_ == "moves") vector.x() = 0.0;
        if (wrong_ == "distance") vector *= 39.4;
        if (wrong_ == "swapped_axes")
          vector = Eigen::Vector3d(vector.y(), vector.x(), vector.z());
        if (wrong_ == "turned_axes")
          vector = Eigen::Vector3d(vector.y(), -vector.x(), vector.z());
        if (wrong_ == "mirrored_axes") vector.y() = -vector.y();
      }
    }
  }

  std::string wrong_, step_;
  std::vector<std::string> steps_;
  HandPrompt last_;
  double time_s_ = 0.0, since_s_ = 0.0;
  Eigen::Vector3d at_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d velocity_m_per_s_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d slow_m_per_s_ = Eigen::Vector3d::Zero();
};

std::map<std::string, RuleOutcome> told_of(Person& person, double step_s = 2.0) {
  std::map<std::string, RuleOutcome> outcomes;
  const TellOutcome tell = [&](const RuleOutcome& outcome) {
    outcomes[std::string(outcome.rule.name)] = outcome;
  };
  RuleJudge judge(tell);
  check_by_hand({.can = person.can_,
                 .step_s = step_s,
                 .watch = [&](double duration_s) { return person.watch(duration_s); },
                 .prompt = [&](const HandPrompt& prompt) { person.obey(prompt); }},
                judge);
  return outcomes;
}

TEST(HandCheck, AGoodDeviceKeepsEveryRule) {
  Person person("nothing");
  const auto told = told_of(person);
  EXPECT_EQ(told.size(), 10U);
  for (const auto& [rule, outcome] : told) {
    EXPECT_EQ(outcome.verdict, RuleOutcome::Verdict::kPassed) << rule << ": " << outcome.found;
  }
}

/// The device and the rule that finds it; it may break others, too.
class EachWrongHand : public ::testing::TestWithParam<std::pair<const char*, const char*>> {};

TEST_P(EachWrongHand, IsFoundByItsRule) {
  Person person(GetParam().first);
  const auto told = told_of(person);
  const RuleOutcome& outcome = told.at(GetParam().second);
  EXPECT_EQ(outcome.verdict, RuleOutcome::Verdict::kFailed) << outcome.found;
  EXPECT_FALSE(outcome.found.empty());
  EXPECT_FALSE(outcome.rule.advice.empty());
}

INSTANTIATE_TEST_SUITE_P(
    Rules, EachWrongHand,
    ::testing::Values(
        std::pair("still", "still"), std::pair("drift", "still"), std::pair("lazy", "moves"),
        std::pair("moves", "moves"), std::pair("distance", "distance"),
        std::pair("swapped_axes", "swapped_axes"), std::pair("turned_axes", "swapped_axes"),
        std::pair("mirrored_axes", "mirrored_axes"), std::pair("points_order", "points_order"),
        std::pair("buttons", "buttons"), std::pair("gripper", "gripper"),
        std::pair("gripper_mm", "gripper"), std::pair("workspace", "workspace"),
        std::pair("large_workspace", "workspace"), std::pair("slow_velocity", "slow_velocity")),
    [](const auto& info) { return std::string(info.param.first); });

TEST(HandCheck, AMirroredFrameIsCalledLeftHandedAndNamesItsAxis) {
  Person person("mirrored_axes");
  const std::string found = told_of(person).at("mirrored_axes").found;
  EXPECT_EQ(found, "moved away from you, it told -100 mm along y, so its frame is left-handed");
}

TEST(HandCheck, EachPromptSaysWhatToDoAndHowLongIsLeft) {
  Person person("nothing");
  (void)told_of(person, 2.0);
  const std::vector<std::string>& steps = person.steps();
  EXPECT_EQ(std::count(steps.begin(), steps.end(), "still"), 2) << "one a second";
  EXPECT_EQ(std::count(steps.begin(), steps.end(), "workspace"), 4);
  for (const char* step :
       {"ready", "right", "away", "up", "thumb", "index", "middle", "buttons", "gripper"}) {
    EXPECT_GE(std::count(steps.begin(), steps.end(), step), 1) << step;
  }
  EXPECT_EQ(person.last().text,
            "Move it as far as it goes: right, left, away, near, up and down");
  EXPECT_EQ(person.last().left_s, 1.0);
}

TEST(HandCheck, WhatADeviceDoesNotHaveIsNotAskedFor) {
  Person person("nothing");
  person.can_.share_ratio = core::area_shares_of_first(1);
  person.can_.channels = 0;
  person.can_.workspace = {core::kInfinity, core::kInfinity, core::kInfinity};
  const auto told = told_of(person);
  for (const char* rule : {"points_order", "buttons", "gripper", "workspace"}) {
    EXPECT_EQ(told.at(rule).verdict, RuleOutcome::Verdict::kSkipped) << rule;
  }
  EXPECT_EQ(std::count(person.steps().begin(), person.steps().end(), "thumb"), 0);
}

TEST(HandCheck, ADeviceThatMovesByItselfIsLeftAlone) {
  Person person("nothing");
  person.can_.moves_by_itself = true;
  for (const auto& [rule, outcome] : told_of(person)) {
    EXPECT_EQ(outcome.verdict, RuleOutcome::Verdict::kSkipped) << rule;
  }
  EXPECT_TRUE(person.steps().empty());
}

/// A hand that swings, with velocities that a filter of this time constant delays, and noise of
/// 0.02 mm.
std::vector<core::HapticState> filtered(double filter_s, double size = 1.0) {
  std::vector<core::HapticState> all;
  double slow_m_per_s = 0.0;
  unsigned noise = 1;
  for (int i = 0; i < 500; ++i) {
    const double time_s = 1e-3 * i;
    const double speed_m_per_s = 0.05 * std::cos(12.0 * time_s);
    slow_m_per_s += (speed_m_per_s - slow_m_per_s) / (1.0 + 1000.0 * filter_s);
    noise = 1664525U * noise + 1013904223U;
    core::HapticState state;
    state.device_time_ns = 1'000'000LL * i;
    state.tip_position_m[0].x() = 0.05 / 12.0 * std::sin(12.0 * time_s) +
                                  4e-5 * (static_cast<double>(noise >> 8) / 16777216.0 - 0.5);
    state.tip_velocity_m_per_s[0].x() = size * slow_m_per_s;
    all.push_back(state);
  }
  return all;
}

TEST(VelocityLag, IsTheTimeConstantOfAFilterAndOnlyLongOnesAreTooLate) {
  for (const double filter_s : {0.0, 0.004, 0.010}) {
    const VelocityLag lag = velocity_lag(filtered(filter_s), 0, 0);
    EXPECT_TRUE(lag.is_known);
    EXPECT_FALSE(lag.is_too_late) << filter_s;
    EXPECT_NEAR(lag.lag_s, filter_s, 0.003);
  }
  for (const double filter_s : {0.025, 0.040}) {
    const VelocityLag lag = velocity_lag(filtered(filter_s), 0, 0);
    EXPECT_TRUE(lag.is_too_late) << filter_s;
    EXPECT_NEAR(lag.lag_s, filter_s, 0.010);
  }
}

TEST(VelocityLag, VelocitiesOfAnotherSizeOrSignAreNotCalledLate) {
  for (const double size : {0.001, -1.0, 2.0, 1000.0}) {
    EXPECT_FALSE(velocity_lag(filtered(0.0, size), 0, 0).is_too_late) << size;
  }
}

TEST(VelocityLag, NothingIsKnownOfAHandThatHardlyMoves) {
  const VelocityLag lag = velocity_lag(filtered(0.040), 0, /*axis=*/2);
  EXPECT_FALSE(lag.is_known);
  EXPECT_FALSE(lag.is_too_late);
  EXPECT_FALSE(velocity_lag({}, 0, 0).is_known);
}

}  // namespace hand_check_test
}  // namespace jnd::device
