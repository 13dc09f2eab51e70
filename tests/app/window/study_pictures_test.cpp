#include "app/window/pictures_fixture.h"

namespace jnd::app {
namespace study_pictures_test {

namespace fs = std::filesystem;

class StudyPicturesTest : public PicturesWindowTest {
 protected:
  void open(const fs::path& study) {
    window_->wait_for_view("start");
    window_->use("open_study");
    window_->wait_for("open_path");
    window_->press("ctrl+a");
    window_->type(study.string());
    window_->press("Return");
  }
};

TEST_F(StudyPicturesTest, OfTheStartAndOfStudiesWithTheirSessionsResultsAndFiles) {
  ASSERT_EQ(jnd({"demo", "--fast", "--out", path("demo").string()}).exit_code, 0);
  window_->start();
  take("start-first");
  window_->use("new_study");
  window_->wait_for("new_folder");
  take("start-new");
  window_->press("F2");
  window_->use("open_study");
  window_->wait_for("open_path");
  take("start-open");
  window_->press("F2");

  write_file(path("draft.json"), replaced(shipped("short_tour").dump(1), R"("repetitions": 1)",
                                          R"("repetitons": 1)"));
  open(path("nowhere.study"));
  window_->wait_for_text("found nothing there");
  take("start-open-wrong");
  window_->press("F2");
  open(path("draft.json"));
  window_->wait_for_text("repetitons");
  take("study-problems");
  window_->use("tab_start");
  for (const char* study : {"magnitude_of_virtual_water", "viscosity_discrimination"}) {
    open(path("demo") / (std::string(study) + ".study"));
    window_->wait_for_view("sessions");
    take(std::string("sessions-") + study);
    window_->use("overview");
    window_->wait_for("prepare");
    take(std::string("overview-") + study);
    window_->use("tab_results");
    const Screen results = window_->wait_for("export");
    for (const Screen::Widget& widget : results.widgets) {
      if (!widget.name.starts_with("page_")) continue;
      window_->use(widget.name);
      take(std::string("results-") + study + "-" + widget.name.substr(5));
    }
    window_->use("participant_3");
    window_->use("page_charts");
    take(std::string("results-") + study + "-one");
    window_->use("tab_study");
    window_->wait_for_view("study");
    take(std::string("study-") + study);
    window_->use("tab_start");
  }
  window_->wait_for_view("start");
  window_->wait_for("study_3");
  take("start");
  close();
}

TEST_F(StudyPicturesTest, OfResultsOfThresholdsStaircasesAndMatches) {
  window_->start();
  for (const char* study : {"viscosity_threshold", "viscosity_staircase", "viscosity_matching",
                            "viscosity_priming", "viscosity_oddity"}) {
    const fs::path folder = path(std::string(study) + ".study");
    ASSERT_EQ(
        jnd({"simulate", study, "--participants", "4", "--fast", "--study", folder.string()})
            .exit_code,
        0);
    open(folder);
    window_->wait_for_view("sessions");
    window_->use("tab_results");
    const Screen results = window_->wait_for("export");
    for (const Screen::Widget& widget : results.widgets) {
      if (!widget.name.starts_with("page_")) continue;
      window_->use(widget.name);
      take(std::string("results-") + study + "-" + widget.name.substr(5), 1);
    }
    window_->use("tab_study");
    window_->wait_for_view("study");
    take(std::string("study-") + study, 1);
    window_->use("tab_start");
  }
  close();
}

}  // namespace study_pictures_test
}  // namespace jnd::app
