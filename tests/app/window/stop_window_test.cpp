#include <gmock/gmock.h>

#include "app/window/window_fixture.h"
#include "app/window/window_studies.h"

namespace jnd::app {
namespace stop_window_test {

const std::string kAge = R"json(, {
    "kind": "questionnaire", "name": "about_you", "instruction": {"en": "You."}, "items": [
      {"name": "age", "kind": "number", "unit": "years", "minimum": 18, "maximum": 99,
       "question": {"en": "How old are you?"}}]})json";

class StopWindowTest : public WindowTest {
 protected:
  /// Returns the force in the footer, which reads for example "4.2 N", or -1 if there is none.
  static double force_n(const Screen& screen) {
    const auto at = std::ranges::find(screen.texts, "Force ");
    if (at == screen.texts.end() || at + 1 == screen.texts.end()) return -1.0;
    return std::stod(*(at + 1));
  }
  void expect_stopped() const {
    window_->wait_for_text("The force is off and stays off.");
    window_->wait_until("no force", [](const Screen& now) { return force_n(now) == 0.0; });
  }
  void rearm() const {
    window_->use("release_stop");
    window_->use("rearm");
    window_->wait_until("force again",
                        [](const Screen& now) { return now.find("rearm") == nullptr; });
  }
};

TEST_F(StopWindowTest, EscapeStopsTheForceFromAnywhereAndTheSessionGoesOnOnceItIsArmedAgain) {
  begin(study_of(kComparison + kAge));
  feel_test();
  window_->wait_until("a force", [](const Screen& now) { return force_n(now) > 0.1; });
  window_->press("Escape");
  expect_stopped();
  // The stop latches: neither the answer nor the pause brings the force back.
  window_->press_at_once({"y", "p", "space"});
  window_->wait_for("release_stop");
  rearm();

  // Escape also stops from a dialog in which somebody is writing.
  feel_test();
  window_->use("note");
  window_->wait_for_text("Write a note");
  window_->type("he said");
  window_->press("Escape");
  expect_stopped();
  EXPECT_TRUE(window_->screen().shows("Write a note")) << "what was written is not lost";
  window_->press("Return");
  rearm();

  // The mouse stops beside a dialog of the session and beside one of the program.
  for (const auto& [opens, closes] : {std::pair("ctrl+n", "F2"), std::pair("F1", "F1")}) {
    feel_test();
    window_->press(opens);
    window_->wait_until("a dialog", [](const Screen& now) {
      return now.offers("dialog_cancel") || now.offers("keys_close");
    });
    window_->click("emergency_stop");
    expect_stopped();
    window_->press(closes);
    rearm();
  }

  for (int trial = 1; trial <= 4; ++trial) {
    wait_for_trial(trial);
    feel_test();
    window_->use("answer_yes");
  }
  window_->use("finish_stage");
  // Escape also stops from a field on the card.
  window_->wait_for("item_text");
  window_->type("4");
  window_->press("Escape");
  expect_stopped();
  rearm();
  window_->wait_for("item_text");
  window_->press("ctrl+a");
  window_->type("41");
  window_->press("Return");
  window_->use("finish_stage");
  window_->wait_for_text("Session finished");
  window_->kill();

  const core::StudyStore store = stored();
  EXPECT_TRUE(store.completed(1));
  EXPECT_EQ(responses(store), (std::vector<double>{1, 1, 1, 1}));
  std::int64_t num_attempts = 0;
  for (const core::TrialRow& trial : store.trials(1)) num_attempts += trial.attempt;
  EXPECT_EQ(num_attempts, 8) << "four were cut short, and each came again at its own place";
  const auto faults = events_of(store, "fault_raised");
  ASSERT_EQ(faults.size(), 5u);
  for (const core::EventRow& fault : faults) {
    EXPECT_THAT(value(fault, "fault"), ::testing::StartsWith("The emergency stop was pressed"));
  }
  const auto notes = written_notes(store);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_EQ(value(notes[0], "text"), "he said");
  EXPECT_EQ(store.answers(1).back().answer, "41");
  expect_verified();
}

}  // namespace stop_window_test
}  // namespace jnd::app
