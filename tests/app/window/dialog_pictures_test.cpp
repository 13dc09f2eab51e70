#include "app/window/pictures_fixture.h"
#include "app/window/window_studies.h"
#include "support/pseudo_terminal.h"

namespace jnd::app {
namespace dialog_pictures_test {

/// Questions before an answer is stored, taken back or corrected, and the choice of where
/// results go.
class DialogPicturesTest : public PicturesWindowTest {
 protected:
  void present() {
    window_->use("present");
    window_->wait_for_text("felt for");
  }
  void leave_dialog(const std::string& widget) {
    window_->press("F2");
    window_->wait_until("the dialog's end",
                        [&](const Screen& now) { return !now.find(widget); });
  }
};

TEST_F(DialogPicturesTest, OfAnAnswerThatIsDoubtedTakenBackAndSetRight) {
  prepare(study_of(kEstimation + "," + kComparison + "," + kProduction), "dialogs.study");
  window_->use("begin");
  window_->confirms_answers = false;
  present();
  window_->type("99999");
  window_->wait_for("answer_percent");
  window_->press("Return");
  window_->wait_for("doubt_store");
  take("dialog-doubt");
  window_->press("s");
  window_->wait_for("present");
  present();
  window_->type("120");
  window_->wait_for("answer_percent");
  window_->press("Return");
  window_->wait_for("doubt_go_back");
  leave_dialog("doubt_store");
  window_->confirms_answers = true;
  window_->type("120");
  window_->wait_for("answer_percent");
  window_->press("Return");
  window_->wait_for("finish_stage");
  take("session-hints");
  window_->press("ctrl+z");
  window_->wait_for("reason_1");
  take("dialog-undo");
  leave_dialog("reason_1");
  window_->click("answer_1");
  window_->wait_for("correct_value");
  window_->type("abc");
  window_->wait_for_text("expected a number");
  take("dialog-correct-number");
  leave_dialog("correct_value");
  window_->use("finish_stage");
  feel_test();
  window_->use("answer_yes");
  wait_for_trial(2);
  window_->click("answer_3");
  window_->wait_for("correct_no");
  take("dialog-correct");
  window_->press("n");
  window_->wait_for("reason");
  take("dialog-correct-why");
  window_->kill();
}

TEST_F(DialogPicturesTest, OfPedalsThatAreMapped) {
  const test_support::PseudoTerminal box;
  const std::string study = path("pedals.json").string();
  write_file(study, replaced(study_of(kComparison), "\"procedure\"",
                             "\"answered_by\": \"participant\", \"procedure\""));
  window_->start({"run", study, "--study", path("pedals.study").string(), "--participant",
                  "P01", "--answer-port", box.path()});
  window_->wait_for_view("prepare");
  window_->use("map_controls");
  window_->wait_for("control_map");
  window_->wait_for_text("listened to");
  window_->press("Return");
  window_->wait_for("control_cancel");
  take("dialog-controls-waits");
  box.send({49});
  window_->wait_for_text("byte 49");
  window_->press("Down");
  window_->press("Return");
  window_->wait_for("control_cancel");
  box.send({50});
  window_->wait_for_text("byte 50");
  take("dialog-controls");
  window_->press("F2");
  window_->wait_until("the dialog's end",
                      [](const Screen& now) { return !now.find("control_map"); });
  window_->wait_for("start_session");
  take("prepare-controls");
  window_->wait_until("the look is over", [](const Screen& now) {
    const auto* start = now.find("start_session");
    return start != nullptr && start->enabled;
  });
  window_->use("start_session");
  window_->use("begin");
  window_->use("present");
  window_->wait_for_text("felt for");
  window_->use("present");
  window_->wait_for("answer_yes");
  take("session-participant-answers");
  box.send({49});
  wait_for_trial(2);
  window_->kill();
}

TEST_F(DialogPicturesTest, OfWhereResultsGo) {
  ASSERT_EQ(jnd({"simulate", "viscosity_discrimination", "--participants", "3", "--fast",
                 "--study", path("three.study").string()})
                .exit_code,
            0);
  window_->start({"run", "viscosity_discrimination", "--study", path("three.study").string(),
                  "--participant", "P04"});
  window_->use("tab_results");
  window_->wait_for_view("results");
  window_->wait_for("export");
  window_->press("ctrl+e");
  window_->wait_for("export_csv");
  take("dialog-export");
  leave_dialog("export_csv");
  window_->press("ctrl+s");
  window_->wait_for("open_written");
  take("results-written");
  window_->kill();
}

}  // namespace dialog_pictures_test
}  // namespace jnd::app
