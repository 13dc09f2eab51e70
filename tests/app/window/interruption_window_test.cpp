// A session that is interrupted in any way continues from where it was.

#include <gmock/gmock.h>

#include <fstream>

#include "app/sentence.h"
#include "app/window/window_fixture.h"
#include "app/window/window_studies.h"
#include "support/small_disk.h"

namespace jnd::app {
namespace interruption_window_test {

using test_support::ProgramOutcome;

class InterruptionWindowTest : public WindowTest {
 protected:
  /// Answers the first trial and begins the second.
  void run_into_trial_2(const std::string& folder = "a.study") {
    begin(study_of(kComparison), folder);
    feel_test();
    window_->use("answer_yes");
    wait_for_trial(2);
    feel_test();
  }
  /// Continues to the end from the card that asks how to resume.
  void go_on_to_the_end() {
    const Screen asked = window_->wait_for("resume_repeat");
    EXPECT_TRUE(asked.shows("1 answer")) << "what is safe";
    window_->use("resume_repeat");
    for (int trial = 2; trial <= 4; ++trial) {
      wait_for_trial(trial);
      feel_test();
      window_->use("answer_no");
    }
    window_->use("finish_stage");
    window_->wait_for_text("Session finished");
    window_->wait_for_text("complete");
    window_->kill();
  }
  void expect_one_yes_then_no(const std::string& folder = "a.study") {
    const core::StudyStore store = stored(folder);
    EXPECT_TRUE(store.completed(1));
    EXPECT_EQ(responses(store), (std::vector<double>{1, 0, 0, 0}));
    EXPECT_EQ(store.trials(1)[1].attempt, 2);
    EXPECT_EQ(store.sessions().size(), 1u);
    expect_verified(folder);
  }
};

TEST_F(InterruptionWindowTest, AKilledSessionIsTheFirstThingOfferedAtTheNextStart) {
  run_into_trial_2();
  window_->kill();
  expect_verified();
  window_->start();
  const Screen start = window_->wait_for("resume_1");
  EXPECT_EQ(start.view, "start");
  EXPECT_TRUE(start.shows("P01 was interrupted in Compare, trial 2 of 4"));
  EXPECT_TRUE(start.shows("1 answer"));
  EXPECT_EQ(start.find("resume_1")->key, "Enter");
  window_->use("resume_1");
  go_on_to_the_end();
  expect_one_yes_then_no();
  EXPECT_EQ(events_of(stored(), "session_resumed").size(), 1u);
}

TEST_F(InterruptionWindowTest, ClosingTheWindowAsksAndLeavesTheSessionToBeResumed) {
  run_into_trial_2();
  window_->press_close_button();
  window_->wait_for_text("Leave the session");
  window_->press("F2");
  window_->wait_until("the card alone", [](const Screen& now) {
    return now.offers("answer_yes") && !now.shows("Leave the session");
  });  // The person stayed, and nothing happened.
  window_->press_close_button();
  window_->wait_for_text("Leave the session");
  window_->type("lunch");
  window_->press("Return");
  const ProgramOutcome left = window_->wait_for_exit();
  EXPECT_EQ(left.exit_code, 0);
  EXPECT_EQ(left.err, "");
  EXPECT_EQ(value(events_of(stored(), "paused").at(0), "reason"), "lunch");
  expect_verified();
  window_->start({"resume", path("a.study").string()});
  go_on_to_the_end();
  expect_one_yes_then_no();
}

TEST_F(InterruptionWindowTest, ALostDisplayEndsTheProgramAndNotTheSession) {
  run_into_trial_2();
  display_->lose();
  const ProgramOutcome outcome = window_->wait_for_exit();
  EXPECT_EQ(outcome.exit_code, 3) << "signal " << outcome.signal;
  EXPECT_THAT(outcome.err,
              ::testing::EndsWith("jnd: the display was lost; every answer is on "
                                  "disk, and a session under way can be resumed\n"));
  expect_verified();
  EXPECT_EQ(responses(stored()), (std::vector<double>{1}));
  display_ = std::make_unique<VirtualDisplay>(1280, 720);
  window_ = std::make_unique<WindowDriver>(*display_, path("person"));
  window_->start({"resume", path("a.study").string()});
  go_on_to_the_end();
  expect_one_yes_then_no();
}

TEST_F(InterruptionWindowTest, AFullDiskStopsTheSessionAtOnceAndSaysWhatIsSafe) {
  std::filesystem::create_directory(path("disk"));
  const test_support::SmallDisk disk(path("disk"), 4000);
  if (!disk.mounted()) GTEST_SKIP() << "mounting a disk is not allowed here";
  begin(study_of(kComparison), "disk/a.study");
  feel_test();
  window_->use("answer_yes");
  wait_for_trial(2);
  {
    std::ofstream ballast(path("disk/ballast"), std::ios::binary);
    while (ballast) ballast << std::string(4096, 'x') << std::flush;
  }
  window_->use("present");
  const Screen failed = window_->wait_for("leave_failed");
  EXPECT_TRUE(failed.shows("full")) << failed.text_after("disk");
  EXPECT_TRUE(failed.shows("Stopped"));
  const auto safe = std::ranges::find(failed.texts, "On disk up to ");
  ASSERT_NE(safe, failed.texts.end());
  EXPECT_EQ(*(safe + 1), "trial 1");
  EXPECT_FALSE(failed.offers("answer_yes"));
  window_->use("leave_failed");
  window_->wait_for_view("sessions");
  window_->kill();
  EXPECT_EQ(responses(stored("disk/a.study")), (std::vector<double>{1}));

  std::filesystem::remove(path("disk/ballast"));
  expect_verified("disk/a.study");
  window_->start({"resume", path("disk/a.study").string()});
  const Screen asked = window_->wait_for("resume_repeat");
  window_->use("resume_repeat");
  wait_for_trial(2);
  feel_test();
  window_->use("answer_no");
  wait_for_trial(3);
  window_->kill();
  EXPECT_EQ(responses(stored("disk/a.study")), (std::vector<double>{1, 0}));
}

TEST_F(InterruptionWindowTest, ASecondInstanceOnTheSameStudyIsRefusedWithTheReason) {
  run_into_trial_2();
  // The command line refuses before any window opens.
  const ProgramOutcome refused = jnd({"resume", path("a.study").string(), "--headless"});
  EXPECT_EQ(refused.exit_code, 1);
  EXPECT_EQ(sentence_flaw(refused.err, {"a.study", "another"}), "");

  // In another window, neither a new session nor this one is possible.
  VirtualDisplay other_display(1280, 720);
  WindowDriver other(other_display, path("other"));
  other.start({"run", path("study.json").string(), "--study", path("a.study").string(),
               "--participant", "P02", "--device", "lumped"});
  other.wait_for_text("To be mended first");
  EXPECT_FALSE(other.screen().offers("start_session"));
  other.use("tab_sessions");
  other.use("resume");
  const Screen told = other.wait_for("message_close");
  EXPECT_TRUE(told.shows("The session cannot be resumed"));
  EXPECT_TRUE(told.shows("another"));
  other.use("message_close");
  other.press_close_button();
  EXPECT_EQ(other.wait_for_exit().exit_code, 0);

  window_->use("answer_no");
  wait_for_trial(3);
  window_->kill();
  const core::StudyStore store = stored();
  EXPECT_EQ(store.sessions().size(), 1u);
  EXPECT_EQ(responses(store), (std::vector<double>{1, 0}));
}

TEST(WithoutADisplay, TheProgramSaysSoInOneSentence) {
  const ProgramOutcome none = test_support::run_program({});
  EXPECT_EQ(none.exit_code, 3);
  EXPECT_EQ(none.out, "");
  EXPECT_EQ(sentence_flaw(none.err, {"no display", "jnd --help"}), "");
  const ProgramOutcome wrong =
      test_support::run_program({}, {.folder = {}, .environment = {{"DISPLAY", ":65000"}}});
  EXPECT_EQ(wrong.exit_code, 3);
  EXPECT_EQ(sentence_flaw(wrong.err, {"no display", ":65000"}), "");
}

}  // namespace interruption_window_test
}  // namespace jnd::app
