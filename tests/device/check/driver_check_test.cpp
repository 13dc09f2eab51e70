#include "device/check/driver_check.h"

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "core/error.h"
#include "device/lumped_hand_device.h"

namespace jnd::device {
namespace driver_check_test {

/// A simulated hand whose driver breaks one rule.
class WrongDevice final : public HapticDevice {
 public:
  explicit WrongDevice(std::string wrong) : wrong_(std::move(wrong)) {}

  [[nodiscard]] std::string_view name() const noexcept override { return "wrong"; }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    DeviceCapabilities can = hand_.capabilities();
    can.share_ratio = core::area_shares_of_first(2);
    can.tells_acting_force = true;
    can.simulated = wrong_ != "real" && wrong_ != "blind";
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
    if (wrong_ == "blind" && num_reads_ > 2400) return false;
    if (wrong_ == "pace" && num_reads_ % 20 == 0) return false;
    if (wrong_ == "time") state.device_time_ns += state.device_time_ns / 10;
    for (auto& at : state.tip_position_m) at *= wrong_ == "units" ? 1000.0 : 1.0;
    for (auto& speed : state.tip_velocity_m_per_s) speed *= wrong_ == "velocity" ? 0.001 : 1.0;
    state.attached = {true, true, false, false, false};
    state.attached[4] = wrong_ == "absent_points";
    state.acted_n = acted_n_;
    return true;
  }
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
    largest_n_ = std::max(largest_n_, force_on_hand_n[0].norm());
    core::PointVectors given_n = force_on_hand_n;
    const double most_n = capabilities().max_force_per_point_n;
    if (wrong_ != "limits" && given_n[0].norm() > most_n)
      given_n[0] *= most_n / given_n[0].norm();
    if (given_n[0].isZero(0.0)) is_halted_ = false;
    if (is_halted_) given_n = core::zero_vectors();
    acted_n_ = given_n;
    if (wrong_ == "force_sign") given_n[0].y() = -given_n[0].y();
    return hand_.write(given_n);
  }
  void close() noexcept override { hand_.close(); }
  void halt() noexcept override { is_halted_ = wrong_ != "halt"; }

  [[nodiscard]] double largest_n() const { return largest_n_; }

 private:
  std::string wrong_;
  LumpedHandDevice hand_{LumpedHandDevice::Parameters{}};
  core::PointVectors acted_n_ = core::zero_vectors();
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
  EXPECT_EQ(told.outcomes.size(), 10U);
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

// A device with other units is tested below, because it breaks more than one rule.
INSTANTIATE_TEST_SUITE_P(Rules, EachWrongDriver,
                         ::testing::Values("opens", "pace", "time", "velocity", "absent_points",
                                           "force_sign", "halt", "limits", "reopens"),
                         [](const auto& info) { return std::string(info.param); });

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
  // The device cannot be read from the time before the first push on.
  WrongDevice device("blind");
  const Told told = told_of(device, /*pushes=*/true);
  EXPECT_EQ(told.outcomes.at("force_sign").verdict, RuleOutcome::Verdict::kFailed);
  EXPECT_EQ(told.outcomes.at("velocity").verdict, RuleOutcome::Verdict::kFailed);
  EXPECT_EQ(device.largest_n(), 0.0);
}

}  // namespace driver_check_test
}  // namespace jnd::device
