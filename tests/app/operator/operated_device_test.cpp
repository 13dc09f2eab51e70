#include "app/operator/operated_device.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <functional>
#include <set>
#include <string>
#include <thread>

#include "app/environment.h"
#include "core/error.h"
#include "experiments/device_profile/profile_reader.h"
#include "experiments/device_profile/profile_writer.h"
#include "support/sound_profile.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace operated_device_test {

namespace fs = std::filesystem;
using Act = DeviceQuestion::Act;
using Step = CommissioningStep;

/// Runs each test in a folder of its own, which is the current folder, as for the program.
class OperatedDeviceTest : public ::testing::Test {
 protected:
  OperatedDeviceTest() : before_(fs::current_path()) { fs::current_path(temporary_.path()); }
  ~OperatedDeviceTest() override { fs::current_path(before_); }

  void wait_until(const std::function<bool(const DeviceView&)>& holds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!holds(device_.view())) {
      ASSERT_LT(std::chrono::steady_clock::now(), end) << device_.view().outcome;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }
  void wait() {
    wait_until([this](const DeviceView&) { return !device_.works(); });
  }
  void choose(const std::string& name = "twin:seed=7") {
    device_.choose(name, "");
    wait();
  }
  void measure(Step step) {
    device_.measure(step);
    wait();
  }
  void measure_all() {
    for (const Step step : kCommissioningSteps) measure(step);
  }

  test_support::TemporaryFolder temporary_;
  fs::path before_;
  EnvironmentVariable config_{"XDG_CONFIG_HOME", temporary_.path().c_str()};
  OperatedDevice device_{[] {}};
};

TEST_F(OperatedDeviceTest, TellsOfADeviceBeforeItIsOpen) {
  choose();
  const DeviceView view = device_.view();
  EXPECT_TRUE(view.is_known);
  EXPECT_TRUE(view.is_simulated);
  EXPECT_EQ(view.profile.status, PreflightLine::Status::kOk);
  EXPECT_EQ(view.next_step, 0U);
  EXPECT_TRUE(view.steps[3].waits) << "for the frame";
  EXPECT_FALSE(fs::exists(view.record)) << "whoever only looks writes nothing";
  choose("plugin:/nowhere/none.so:real");
  EXPECT_FALSE(device_.view().is_known);
  EXPECT_NE(device_.view().problem, "");
  choose("no such thing");
  EXPECT_NE(device_.view().problem.find("no such thing"), std::string::npos);
}

TEST_F(OperatedDeviceTest, MeasuresStepByStepAndGoesOnWithTheTerminalsRecord) {
  choose();
  measure(Step::kHoming);
  EXPECT_EQ(device_.view().next_step, 1U);
  EXPECT_FALSE(device_.view().steps[0].found.empty());
  measure(Step::kNoise);
  EXPECT_EQ(device_.view().next_step, 2U);
  EXPECT_TRUE(device_.view().outcome_is_good) << device_.view().outcome;
  EXPECT_TRUE(fs::exists("twin_seed_7.commissioning.jsonl"));
  measure(Step::kForce);
  EXPECT_FALSE(device_.view().outcome_is_good) << "its frame comes first";
  for (const Step step : {Step::kFrame, Step::kForce, Step::kDelay}) measure(step);
  EXPECT_EQ(device_.view().next_step, 5U);
  {
    OperatedDevice another([] {});
    another.choose("twin:seed=7", "");
    while (another.works()) std::this_thread::yield();
    EXPECT_EQ(another.view().next_step, 5U) << "what was measured is on disk";
  }
  device_.undo(Step::kFrame);
  wait();
  EXPECT_EQ(device_.view().next_step, 2U);
  EXPECT_TRUE(device_.view().steps[4].measured_at.empty()) << "it rests on the frame";
}

TEST_F(OperatedDeviceTest, WritesTheProfileAndChecksItDaily) {
  choose();
  device_.check_daily();
  wait();
  EXPECT_FALSE(device_.view().outcome_is_good) << "it has none yet";
  measure_all();
  device_.write_profile();
  wait();
  EXPECT_TRUE(device_.view().outcome_is_good) << device_.view().outcome;
  ASSERT_NE(device_.view().profile_file, "");
  EXPECT_GE(device_.view().profile_numbers.size(), 6U);
  device_.check_daily();
  wait();
  const DeviceView checked = device_.view();
  EXPECT_EQ(checked.check_passed, true);
  EXPECT_EQ(checked.checked.size(), 8U);
  ASSERT_EQ(checked.checks.size(), 1U);
  EXPECT_TRUE(checked.checks.front().passed);

  choose("twin:seed=7,drifted_gain_ratio=0.95");
  device_.check_daily();
  wait();
  EXPECT_EQ(device_.view().check_passed, false);
  ASSERT_EQ(device_.view().checks.size(), 2U);
  EXPECT_FALSE(device_.view().checks.front().passed) << "the last one first";
  EXPECT_EQ(experiments::read_device_profile(device_.view().profile_file).checks.size(), 2U);
}

TEST_F(OperatedDeviceTest, AsksForEveryThingThatIsToBeDoneAndWaits) {
  choose();
  device_.set_rehearsing(true);
  std::set<Act> asked;
  int num_marks = 0;
  for (const Step step : kCommissioningSteps) {
    device_.measure(step);
    while (device_.works()) {
      if (const auto question = device_.view().question) {
        EXPECT_FALSE(question->words.empty());
        asked.insert(question->act);
        num_marks += question->act == Act::kTouch ? 1 : 0;
        EXPECT_TRUE(device_.is_live());
        device_.answer();
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    EXPECT_TRUE(device_.view().outcome_is_good) << device_.view().outcome;
  }
  EXPECT_EQ(asked.size(), 7U);
  EXPECT_GE(num_marks, 8);
  EXPECT_FALSE(device_.view().next_step);
}

TEST_F(OperatedDeviceTest, WhoLeavesOffKeepsWhatWasMeasured) {
  choose();
  measure(Step::kHoming);
  measure(Step::kNoise);
  device_.set_rehearsing(true);
  device_.measure(Step::kFrame);
  wait_until([](const DeviceView& now) { return now.question.has_value(); });
  device_.leave_off();
  wait();
  EXPECT_FALSE(device_.view().outcome_is_good);
  EXPECT_NE(device_.view().outcome.find("kept"), std::string::npos) << device_.view().outcome;
  EXPECT_EQ(device_.view().next_step, 2U);
  EXPECT_FALSE(device_.view().stop_is_pressed) << "nobody pressed the emergency stop";
  device_.set_rehearsing(false);
  measure(Step::kFrame);
  EXPECT_TRUE(device_.view().outcome_is_good) << device_.view().outcome;
}

TEST_F(OperatedDeviceTest, TheEmergencyStopEndsAStepAndKeepsTheNextFromBeginning) {
  choose();
  device_.set_rehearsing(true);
  device_.measure(Step::kNoise);
  wait_until([](const DeviceView& now) { return now.question.has_value(); });
  std::jthread([this] { device_.press_stop(); }).join();
  wait();
  EXPECT_FALSE(device_.view().outcome_is_good);
  EXPECT_TRUE(device_.view().stop_is_pressed);
  device_.set_rehearsing(false);
  measure(Step::kHoming);
  EXPECT_EQ(device_.view().next_step, 0U);
  device_.release_stop();
  measure(Step::kHoming);
  EXPECT_EQ(device_.view().next_step, 1U);
}

TEST_F(OperatedDeviceTest, AStopIsNotReleasedByTheEndOfAStepThatWasLeft) {
  choose();
  device_.set_rehearsing(true);
  device_.measure(Step::kNoise);
  wait_until([](const DeviceView& now) { return now.question.has_value(); });
  device_.press_stop();
  device_.leave_off();
  wait();
  EXPECT_TRUE(device_.view().stop_is_pressed);
}

TEST_F(OperatedDeviceTest, TriesASmallForce) {
  choose("twin");
  device_.try_force(0);
  wait();
  EXPECT_TRUE(device_.view().outcome_is_good);
  EXPECT_NE(device_.view().outcome.find("moved it there"), std::string::npos)
      << device_.view().outcome;
  choose("twin:friction_n=1.5");
  device_.try_force(2);
  wait();
  EXPECT_NE(device_.view().outcome.find("did not move it"), std::string::npos)
      << device_.view().outcome;
}

TEST_F(OperatedDeviceTest, ShowsWhatTheDeviceTellsUntilItIsLeft) {
  choose();
  device_.watch();
  wait_until([](const DeviceView& now) { return !now.live.empty(); });
  EXPECT_EQ(device_.view().live.front().what, "Enabling switch");
  EXPECT_EQ(device_.view().work, DeviceWork::kWatching);
  EXPECT_TRUE(device_.is_live()) << "nothing leads away from a device that is open";
  device_.leave_off();
  wait();
  EXPECT_TRUE(device_.view().outcome_is_good) << device_.view().outcome;
  EXPECT_EQ(device_.view().outcome, "");
  EXPECT_FALSE(device_.view().stop_is_pressed);
  measure(Step::kHoming);
  EXPECT_TRUE(device_.view().outcome_is_good) << "the device is free again";
}

TEST_F(OperatedDeviceTest, TheEmergencyStopEndsTheWatchingToo) {
  choose();
  device_.watch();
  wait_until([](const DeviceView& now) { return !now.live.empty(); });
  device_.press_stop();
  wait();
  EXPECT_TRUE(device_.view().stop_is_pressed);
}

TEST_F(OperatedDeviceTest, EndsAtOnceWhileItAsks) {
  choose();
  device_.set_rehearsing(true);
  auto another = std::make_unique<OperatedDevice>([] {});
  another->choose("twin:seed=8", "");
  while (another->works()) std::this_thread::yield();
  another->set_rehearsing(true);
  another->measure(Step::kNoise);
  another.reset();
  SUCCEED() << "a window that is closed does not hang";
}

}  // namespace operated_device_test
}  // namespace jnd::app
