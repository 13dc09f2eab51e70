#include "app/window/window_fixture.h"
#include "app/window/window_studies.h"

namespace jnd::app {
namespace comparison_window_test {

class ComparisonWindowTest : public WindowTest {};

TEST_F(ComparisonWindowTest, ABlockWithUndoPauseAndNoteIsStoredAsItWasClicked) {
  begin(study_of(kComparison));
  feel_test();
  window_->use("answer_yes");
  wait_for_trial(2);
  feel_test();
  window_->use("answer_yes");
  wait_for_trial(3);

  // The second answer was a mistake, so it is taken back.
  window_->use("undo");
  window_->wait_for_text("Undo the last answer");
  window_->use("reason_2");
  wait_for_trial(2);
  feel_test();
  window_->use("answer_no");
  wait_for_trial(3);

  // After a pause in the middle of a presentation, the trial is run again.
  feel_test();
  window_->use("pause");
  window_->wait_for_text("Paused. Why?");
  EXPECT_EQ(events_of(stored(), "paused").size(), 1U) << "before anybody says why";
  window_->use("reason_5");
  window_->wait_for("reason");
  window_->type("a phone rang");
  window_->wait_for("dialog_do");
  window_->press("Return");
  window_->wait_for("go_on");
  window_->use("note");
  window_->wait_for_text("Write a note");
  window_->type("It was the door.");
  window_->press("Return");
  window_->use("go_on");
  feel_test();
  window_->use("answer_no");
  wait_for_trial(4);
  feel_test();
  window_->use("present_reference");
  window_->wait_for_text("Test again");
  window_->use("present_test");
  window_->wait_for("answer_yes");
  window_->use("answer_yes");
  window_->use("finish_stage");
  window_->wait_for_text("Session finished");
  window_->kill();

  const core::StudyStore store = stored();
  EXPECT_TRUE(store.completed(1));
  EXPECT_EQ(responses(store), (std::vector<double>{1, 0, 0, 1}));
  std::vector<std::int64_t> attempts;
  for (const core::TrialRow& trial : store.trials(1)) attempts.push_back(trial.attempt);
  EXPECT_EQ(attempts, (std::vector<std::int64_t>{1, 2, 2, 1}));
  EXPECT_EQ(store.trials(1)[3].num_presentations, 4);
  const auto undone = events_of(store, "answer_undone");
  ASSERT_EQ(undone.size(), 1u);
  EXPECT_EQ(undone[0].trial, 2);
  EXPECT_EQ(value(undone[0], "reason"), "the wrong key was pressed");
  const auto paused = events_of(store, "paused");
  ASSERT_EQ(paused.size(), 1u);
  EXPECT_EQ(value(paused[0], "reason"), "");
  const auto explained = events_of(store, "pause_explained");
  ASSERT_EQ(explained.size(), 1u);
  EXPECT_EQ(value(explained[0], "reason"), "a phone rang");
  EXPECT_EQ(events_of(store, "continued").size(), 1u);
  const auto notes = written_notes(store);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(value(notes[0], "text"), "It was the door.");
  expect_verified();
}

TEST_F(ComparisonWindowTest, KeysPressedFasterThanTheScreenAreNeitherLostNorDoubled) {
  begin(study_of(kComparison));
  window_->wait_for("present");
  // The person presses the keys of the reference, the test and the answer before any of them
  // can be seen.
  window_->press_at_once({"r", "t", "y"});
  wait_for_trial(2);
  // An answer that is pressed twice does not affect the next trial.
  feel_test();
  window_->press_at_once({"n", "n"});
  wait_for_trial(3);
  window_->press_at_once({"space", "space", "t", "y", "y"});
  wait_for_trial(4);
  // The keys of the next trial follow right after the answer.
  window_->press_at_once({"r", "t", "r", "t", "n"});
  window_->wait_for("finish_stage");
  window_->kill();

  const core::StudyStore store = stored();
  EXPECT_EQ(responses(store), (std::vector<double>{1, 0, 1, 0}));
  std::vector<std::string> felt(4);
  for (const core::PresentationRow& row : store.presentations(1)) {
    felt.at(static_cast<std::size_t>(row.trial) - 1) += row.interval + " ";
  }
  EXPECT_EQ(felt[0], "reference test ");
  EXPECT_EQ(felt[1], "reference test ");
  EXPECT_EQ(felt[2], "reference test test ");
  EXPECT_EQ(felt[3], "reference test reference test ");
  EXPECT_EQ(events_of(store, "trial_answered").size(), 4u);
}

}  // namespace comparison_window_test
}  // namespace jnd::app
