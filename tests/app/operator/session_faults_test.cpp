#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "app/operator/operated_session_fixture.h"
#include "app/operator/remembered_stop.h"
#include "core/error.h"
#include "core/safety/fault.h"
#include "core/storage/flight_record.h"
#include "core/storage/integrity.h"
#include "support/files.h"

namespace jnd::app {
namespace session_faults_test {

/// Faults in a row, and pauses around them.
class SessionFaultsTest : public OperatedSessionTest {
 protected:
  /// Continues in a block at its next trial, on a device with this fault between these times in
  /// seconds.
  SessionView go_on_with(device::Injection injection, double from_s, double to_s) {
    open();
    run_to_block("comparison");
    reopen({{.first_tick = std::llround(1000.0 * from_s),
             .num_ticks = std::llround(1000.0 * (to_s - from_s)),
             .injection = injection,
             .magnitude = 2.0}});
    return act(operate::Begin{"repeat"});
  }

  void stop() {
    exchange_.emergency_stop.press();
    pass(0.05);
    EXPECT_EQ(view().step, Step::kFault);
  }
  SessionView rearm() {
    if (view().stop_pressed) {
      act(operate::ReleaseStop{view().num_stop_presses});
      pass(0.6);  // No sooner may anybody arm.
    }
    act(operate::Rearm{view().telemetry.num_faults});
    pass(0.05);
    return view();
  }
  [[nodiscard]] std::vector<std::string> faults_stored() const {
    std::vector<std::string> data;
    for (const core::EventRow& event : store_->events(session_number_)) {
      if (event.kind == "fault_raised") data.push_back(event.data);
    }
    return data;
  }
  [[nodiscard]] std::size_t num_flight_records() const {
    return core::flight_records(store_->recording_file(session_number_)).size();
  }
};

TEST_F(SessionFaultsTest, AStopDuringAPauseEndsThePauseForNobody) {
  open();
  const std::int64_t trial = run_to_block("comparison").trial->trial;
  act(operate::Present{trial, "reference"});
  pass(0.5);
  act(operate::Pause{"the magnets are looked after"});
  stop();
  const SessionView armed = rearm();
  EXPECT_EQ(armed.fault, "");
  EXPECT_EQ(armed.step, Step::kPaused) << "whoever paused goes on";
  EXPECT_EQ(std::ranges::count(kinds(), "continued"), 0);
  EXPECT_EQ(act(operate::GoOn{}).step, Step::kReady);
}

TEST_F(SessionFaultsTest, AStopWithoutAPauseGoesOnByItselfAlsoASecondTime) {
  open();
  run_to_block("comparison");
  for (int time = 1; time <= 2; ++time) {
    stop();
    EXPECT_EQ(rearm().step, Step::kReady);
    EXPECT_EQ(std::ranges::count(kinds(), "continued"), time);
  }
}

TEST_F(SessionFaultsTest, AfterThreeFaultsSomebodyHasToLook) {
  open();
  run_to_block("comparison");
  std::vector<device::ScheduledFault> faults;
  for (const std::int64_t at_tick : {1000, 3000, 5000}) {
    faults.push_back({.first_tick = at_tick, .injection = device::Injection::kReadFailure});
  }
  reopen(faults);
  act(operate::Begin{"repeat"});
  for (int fault = 1; fault <= 3; ++fault) {
    for (int i = 0; i < 200 && view().step != Step::kFault; ++i) pass(0.05);
    ASSERT_EQ(view().step, Step::kFault) << fault;
    if (fault < 3) {
      EXPECT_NE(rearm().step, Step::kFault) << fault;
    }
  }
  EXPECT_NE(act(operate::Rearm{view().telemetry.num_faults}).refusal.find("three faults"),
            std::string::npos);
  EXPECT_EQ(view().step, Step::kFault);
}

TEST_F(SessionFaultsTest, NothingGoesOnByItselfWithALooseFinger) {
  const std::int64_t trial =
      go_on_with(device::Injection::kDetachedPoint, 1.5, 3.0).trial->trial;
  act(operate::Present{trial, "reference"});
  pass(0.5);
  stop();
  pass(1.2);
  const SessionView armed = rearm();
  EXPECT_EQ(armed.step, Step::kPaused);
  EXPECT_EQ(armed.loose_points, "the index finger");
  EXPECT_NE(act(operate::GoOn{}).refusal.find("the index finger"), std::string::npos);
  pass(2.0);
  EXPECT_EQ(act(operate::GoOn{}).step, Step::kReady);
}

TEST_F(SessionFaultsTest, AFaultThatFollowsOnArmingIsToldAndKeptLikeTheFirst) {
  // The hand leaves the workspace while there is no force, and comes back later.
  go_on_with(device::Injection::kPositionJump, 0.5, 2.0);
  stop();
  EXPECT_EQ(num_flight_records(), 1U);
  pass(0.6);
  SessionView armed = rearm();
  EXPECT_EQ(armed.step, Step::kFault);
  EXPECT_EQ(armed.fault_name, "outside_workspace");
  EXPECT_EQ(armed.fault, core::words(core::Fault::kOutsideWorkspace));
  ASSERT_EQ(faults_stored().size(), 2U);
  const std::string start(core::words(core::Fault::kOutsideWorkspace).substr(0, 15));
  EXPECT_NE(faults_stored().back().find(start), std::string::npos) << faults_stored().back();
  EXPECT_EQ(num_flight_records(), 2U);

  // The same fault again is a new fault.
  armed = rearm();
  EXPECT_EQ(armed.fault_name, "outside_workspace");
  EXPECT_EQ(faults_stored().size(), 3U);
  EXPECT_EQ(num_flight_records(), 3U);

  pass(1.5);
  EXPECT_EQ(faults_stored().size(), 3U) << "one that stays is none more";
  EXPECT_EQ(rearm().step, Step::kReady);
  answer_trial(view(), 1.0);
  session_.reset();
  EXPECT_TRUE(core::verify(*store_).problems.empty());
}

/// The program ended with the stop pressed, so the next one has a new exchange.
TEST_F(SessionFaultsTest, AStopHoldsForTheNextSessionAndTheNextStart) {
  stops_ = temporary_.path() / "state";
  open();
  run_to_block("comparison");
  stop();
  ASSERT_TRUE(is_stop_remembered(stops_, "lumped"));
  act(operate::Leave{});
  session_.reset();
  ASSERT_TRUE(exchange_.emergency_stop.release(exchange_.emergency_stop.num_presses()));

  reopen();
  EXPECT_TRUE(view().stop_pressed);
  EXPECT_EQ(view().step, Step::kFault);
  EXPECT_EQ(view().fault_name, "emergency_stop");
  EXPECT_EQ(act(operate::Rearm{}).step, Step::kFault);
  act(operate::ReleaseStop{view().num_stop_presses});
  EXPECT_EQ(view().step, Step::kFault) << "releasing is no arming";
  EXPECT_NE(act(operate::Rearm{view().telemetry.num_faults}).refusal.find("just now"),
            std::string::npos)
      << "a click that was meant as one";
  pass(0.6);
  act(operate::Rearm{view().telemetry.num_faults});
  pass(0.1);
  EXPECT_EQ(view().step, Step::kBegin);
  EXPECT_FALSE(is_stop_remembered(stops_, "lumped"));
}

TEST_F(SessionFaultsTest, AStopAfterAnotherFaultIsRememberedAndHasToBeReleased) {
  stops_ = temporary_.path() / "state";
  open();
  run_to_block("comparison");
  reopen({{.first_tick = 1000, .injection = device::Injection::kReadFailure}});
  act(operate::Begin{"repeat"});
  for (int i = 0; i < 200 && view().step != Step::kFault; ++i) pass(0.05);
  ASSERT_EQ(view().fault_name, "device_read_failed");
  const std::uint64_t seen = view().telemetry.num_faults;
  stop();
  EXPECT_EQ(view().fault_name, "emergency_stop");
  EXPECT_TRUE(is_stop_remembered(stops_, "lumped"));
  EXPECT_NE(act(operate::Rearm{seen}).refusal.find("release it first"), std::string::npos);
  act(operate::ReleaseStop{view().num_stop_presses});
  pass(0.6);
  EXPECT_NE(act(operate::Rearm{seen}).refusal.find("another fault"), std::string::npos)
      << "asked for before the stop";
  EXPECT_NE(rearm().step, Step::kFault);
}

TEST_F(SessionFaultsTest, NoCommandArmsADeviceWhoseStopNobodyHasReleased) {
  const std::filesystem::path folder = temporary_.path() / "state";
  EXPECT_NO_THROW(require_stop_released(folder, "plugin:robot.so", false));
  remember_stop(folder, "plugin:robot.so");
  EXPECT_THROW(require_stop_released(folder, "plugin:robot.so,port=2", false), core::Error)
      << "the same device, used otherwise";
  EXPECT_NO_THROW(require_stop_released(folder, "plugin:robot.so", true));
  EXPECT_TRUE(is_stop_remembered(folder, "plugin:robot.so")) << "nothing is armed yet";
  forget_stop(folder, "plugin:robot.so");
  EXPECT_NO_THROW(require_stop_released(folder, "plugin:robot.so", false)) << "released";
}

TEST_F(SessionFaultsTest, AWindowThatNobodySeesGivesNoSignOfLife) {
  const std::uint64_t count = exchange_.heartbeat.count();
  exchange_.beat(/*is_in_sight=*/false);
  EXPECT_EQ(exchange_.heartbeat.count(), count);
  exchange_.beat(/*is_in_sight=*/true);
  EXPECT_EQ(exchange_.heartbeat.count(), count + 1);
}

TEST_F(SessionFaultsTest, AStopOfOneDeviceIsNoneOfAnother) {
  const std::filesystem::path folder = temporary_.path() / "state";
  remember_stop(folder, "network:10.0.0.2:5000");
  EXPECT_TRUE(is_stop_remembered(folder, "network:10.0.0.2:5000"));
  EXPECT_FALSE(is_stop_remembered(folder, "network:10.0.0.2:5001"));
  EXPECT_FALSE(is_stop_remembered("", "network:10.0.0.2:5000"));
  forget_stop(folder, "network:10.0.0.2:5000");
  EXPECT_FALSE(is_stop_remembered(folder, "network:10.0.0.2:5000"));
}

TEST_F(SessionFaultsTest, AStopIsTheDevicesHoweverItsNameIsSpelt) {
  namespace fs = std::filesystem;
  const fs::path folder = temporary_.path() / "state";
  const fs::path driver = temporary_.path() / "robot.so";
  test_support::write_file(driver, "a driver");
  fs::create_symlink(driver, temporary_.path() / "other.so");
  const std::string whole = "plugin:" + driver.string();
  remember_stop(folder, whole);
  EXPECT_TRUE(is_stop_remembered(folder, "plugin:" + fs::relative(driver).string()));
  EXPECT_TRUE(is_stop_remembered(
      folder, "plugin:" + (temporary_.path() / "state" / ".." / "robot.so").string()));
  EXPECT_TRUE(
      is_stop_remembered(folder, "plugin:" + (temporary_.path() / "other.so").string()));
  EXPECT_FALSE(is_stop_remembered(folder, "plugin:" + driver.string() + "x"));
  forget_stop(folder, "plugin:" + fs::relative(driver).string());
  EXPECT_FALSE(is_stop_remembered(folder, whole));

  remember_stop(folder, "network:localhost:5000,key=robot");
  EXPECT_TRUE(is_stop_remembered(folder, "network:127.0.0.1:5000"));

  const std::string deep = std::string(100, 'x') + "/";
  const std::string far = "plugin:/opt/" + deep + deep + deep + "robot.so";
  remember_stop(folder, far);
  EXPECT_TRUE(is_stop_remembered(folder, far)) << "too long for the name of a file";
}

TEST_F(SessionFaultsTest, AStopThatAnEarlierVersionRememberedHolds) {
  const std::filesystem::path folder = temporary_.path() / "state";
  std::filesystem::create_directories(folder);
  test_support::write_file(folder / "stop_network-3alocalhost-3a5000", "");
  EXPECT_TRUE(is_stop_remembered(folder, "network:localhost:5000,key=robot"));
  forget_stop(folder, "network:localhost:5000");
  EXPECT_FALSE(is_stop_remembered(folder, "network:localhost:5000"));
}

}  // namespace session_faults_test
}  // namespace jnd::app
