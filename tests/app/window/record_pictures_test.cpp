#include "app/window/pictures_fixture.h"
#include "app/window/window_studies.h"

namespace jnd::app {
namespace record_pictures_test {

namespace fs = std::filesystem;

/// Takes pictures of a stored session, of the state of a study, and of the schedule.
class RecordPicturesTest : public PicturesWindowTest {
 protected:
  void open_sessions(const fs::path& folder) {
    window_->start();
    window_->wait_for_view("start");
    window_->use("open_study");
    window_->wait_for("open_path");
    window_->press("ctrl+a");
    window_->type(folder.string());
    window_->press("Return");
    window_->wait_for_view("sessions");
  }
  void open_record(int num_down) {
    for (int i = 0; i < num_down; ++i) window_->press("Down");
    window_->use("show_session");
    window_->wait_for_view("record");
    window_->wait_for("page_answers");
  }
  void take_pages(const std::string& name) {
    for (const char* page : {"timeline", "answers", "notes", "faults"}) {
      window_->use(std::string("page_") + page);
      if (std::string(page) == "answers") {
        for (int i = 0; i < 3; ++i) window_->press("Down");
      }
      take(name + "-" + page);
    }
  }
};

TEST_F(RecordPicturesTest, OfAStudyWithAScheduleAndASessionWithEverythingInIt) {
  const fs::path folder = path("viscosity.study");
  ASSERT_EQ(jnd({"simulate", "viscosity_discrimination", "--participants", "5", "--fast",
                 "--study", folder.string()})
                .exit_code,
            0);
  ASSERT_EQ(jnd({"exclude", folder.string(), "--session", "1", "--trial", "3", "9", "--reason",
                 "a door slammed"})
                .exit_code,
            0);
  ASSERT_EQ(jnd({"adverse-event", folder.string(), "--session", "1", "--text",
                 "a pinched finger, seen to at once"})
                .exit_code,
            0);
  open_sessions(folder);
  open_record(1);
  window_->press("n");
  window_->wait_for("reason");
  window_->type("long hair under the glove; tied back after the second block");
  window_->press("Return");
  window_->wait_until("the note", [](const Screen& now) {
    return now.find("reason") == nullptr && now.find("page_notes") != nullptr;
  });
  take_pages("record");
  window_->use("page_answers");
  window_->press("x");
  window_->wait_for("reason");
  take("record-exclude");
  window_->press("F2");
  window_->press("w");
  window_->wait_for("reason");
  take("record-withdraw");
  window_->press("F2");
  window_->use("tab_sessions");
  window_->wait_for_view("sessions");
  window_->use("overview");
  window_->wait_for("prepare");
  window_->press("p");
  window_->wait_for("planned_number");
  window_->press("ctrl+a");
  window_->type("12");
  window_->press("Return");
  window_->wait_for_text("5 of 12");
  for (const char* who : {"P06", "P07", "P08"}) {
    window_->press("a");
    window_->wait_for("appointment_participant");
    window_->press("ctrl+a");
    window_->type(who);
    if (std::string(who) == "P07") take("overview-appointment");
    window_->press("Return");
    window_->wait_until("the appointment", [&](const Screen& now) {
      return now.shows(who) && now.find("appointment_participant") == nullptr;
    });
  }
  window_->press("Down");
  take("overview");
  close();
}

TEST_F(RecordPicturesTest, OfASessionThatWasStoppedAndPaused) {
  begin(study_of(kComparison + "," + kEstimation), "stopped.study");
  feel_test();
  window_->use("answer_yes");
  wait_for_trial(2);
  feel_test();
  window_->press("Escape");
  window_->use("release_stop");
  window_->use("rearm");
  feel_test();
  window_->use("answer_no");
  wait_for_trial(3);
  window_->use("pause");
  window_->wait_for("reason_1");
  window_->press("1");
  window_->use("go_on");
  window_->wait_for("present");
  window_->press("ctrl+w");
  window_->wait_for("dialog_do");
  window_->press("Return");
  window_->wait_for_view("sessions");
  open_record(1);
  take_pages("record-stopped");
  window_->kill();
}

TEST_F(RecordPicturesTest, OfAStudyThatHasNothingYetAndOfOneThatIsBlind) {
  window_->start();
  window_->wait_for_view("start");
  window_->use("new_study");
  window_->wait_for("new_folder");
  window_->type("viscosity_discrimination");
  window_->click("new_folder");
  window_->press("ctrl+a");
  window_->type(path("empty.study").string());
  window_->press("Return");
  window_->wait_for_view("sessions");
  take("sessions-empty", 1);
  window_->use("overview");
  window_->wait_for("prepare");
  take("overview-empty");
  close();
  write_file(path("blind.json"),
             replaced(shipped("viscosity_discrimination").dump(1),
                      R"("blinding": "participant")", R"("blinding": "double")"));
  ASSERT_EQ(jnd({"simulate", path("blind.json").string(), "--participants", "3", "--fast",
                 "--study", path("blind.study").string()})
                .exit_code,
            0);
  open_sessions(path("blind.study"));
  open_record(1);
  window_->use("page_answers");
  take("record-blind");
  window_->use("tab_sessions");
  window_->wait_for_view("sessions");
  window_->use("overview");
  window_->wait_for("prepare");
  take("overview-blind");
  close();
}

}  // namespace record_pictures_test
}  // namespace jnd::app
