#include <gmock/gmock.h>

#include "app/blind_study.h"
#include "app/window/window_fixture.h"

namespace jnd::app {
namespace blind_window_test {

namespace fs = std::filesystem;

class BlindWindowTest : public WindowTest {
 protected:
  /// Runs the whole session, with the participant's screen beside it.
  void run_session() {
    begin(kBlindStudy);
    // There is only one monitor, so the participant's screen is a window on it.
    window_->press("F9");
    window_->use("screen_1");
    window_->use("screen_close");
    window_->use("feel_medium");
    window_->use("finish_medium");
    for (int block = 0; block < 2; ++block) {
      const Screen first = window_->wait_for("present");
      const bool compares = first.find("present")->label == "Present the reference";
      for (int trial = 1; trial <= (compares ? 2 : 1); ++trial) {
        wait_for_trial(trial);
        feel_test();
        look_at_apparatus();
        if (!compares) {
          window_->use("raise_coarse");
          window_->use("matches");
        } else {
          window_->use("answer_yes");
        }
      }
      window_->use("finish_stage");
      window_->wait_until("the next",
                          [](const Screen& now) { return !now.find("finish_stage"); });
    }
    window_->wait_for_text("Session finished");
    window_->wait_for_text("complete");
    window_->press("F9");
    window_->use("screen_0");
    window_->use("screen_close");
  }
  /// Opens and closes the view of the apparatus while something is felt.
  void look_at_apparatus() {
    window_->use("apparatus");
    window_->wait_for_text("none of them is shown");
    window_->use("apparatus");
    window_->wait_for_view("session");
  }
  /// Opens every other view of the study.
  void look_around() {
    window_->use("to_sessions");
    window_->wait_for_view("overview");
    window_->wait_for("prepare");
    window_->use("tab_sessions");
    window_->wait_for_view("sessions");
    window_->press("Down");
    window_->use("show_session");
    window_->wait_for_view("record");
    for (const char* page : {"page_answers", "page_notes", "page_faults", "page_timeline"}) {
      window_->use(page);
    }
    window_->use("back");
    window_->wait_for_view("sessions");
    for (const char* tab : {"tab_results", "tab_study", "tab_sessions"}) {
      window_->use(tab);
      window_->wait_for_view(std::string(tab).substr(4));
      window_->press("F1");
      window_->wait_for("keys_close");
      window_->press("F1");
      window_->wait_until("the dialog's end",
                          [](const Screen& now) { return !now.find("keys_close"); });
    }
    window_->use("new_session");
    window_->wait_for_view("prepare");
    window_->wait_for("start_session");
    window_->use("real_session");
  }
  [[nodiscard]] std::string texts_of_all_files_in(const fs::path& folder) const {
    std::string all;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (entry.is_regular_file())
        all += entry.path().string() + "\n" + read_file(entry.path());
    }
    return all;
  }
};

TEST_F(BlindWindowTest,
       NothingThatIsDrawnPrintedKeptOrExportedTellsALevelUntilTheStudyIsUnblinded) {
  run_session();
  look_around();
  window_->press_close_button();
  const test_support::ProgramOutcome outcome = window_->wait_for_exit();
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_THAT(told_by(outcome.out), ::testing::IsEmpty());
  EXPECT_THAT(told_by(outcome.err), ::testing::IsEmpty());
  const std::string seen = window_->every_text();
  EXPECT_THAT(told_by(seen), ::testing::IsEmpty());
  for (const char* view : {"Block 1", "Block 2", "So?", "More?", "Session finished",
                           "Thank you!", "none of them is shown"}) {
    EXPECT_NE(seen.find(view), std::string::npos) << view << ": the log is whole";
  }
  EXPECT_THAT(told_by(texts_of_all_files_in(path("person/state"))), ::testing::IsEmpty());
  for (const char* format : {"csv"}) {
    const auto refused =
        jnd({"export", format, path("a.study").string(), "--out", path("exported").string()});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(told_by(refused.out + refused.err), ::testing::IsEmpty());
    EXPECT_FALSE(fs::exists(path("exported")));
  }
  EXPECT_FALSE(fs::exists(path("a-csv")));
  EXPECT_FALSE(fs::exists(path("a-report")));

  // As a counter-check, the unblinded window does show the words that the test looks for.
  ASSERT_EQ(jnd({"unblind", path("a.study").string(), "--reason", "done"}).exit_code, 0);
  window_->start({"run", path("study.json").string(), "--study", path("a.study").string(),
                  "--participant", "P02", "--device", "lumped"});
  window_->use("tab_study");
  window_->wait_for_text("0.2719");
  EXPECT_GE(told_by(window_->every_text()).size(), 6u);
}

}  // namespace blind_window_test
}  // namespace jnd::app
