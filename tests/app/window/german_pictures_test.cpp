#include <cstdlib>

#include "app/environment.h"
#include "app/window/pictures_fixture.h"

namespace jnd::app {
namespace german_pictures_test {

namespace fs = std::filesystem;

/// Takes pictures of the window in German at its smallest size, so that people can see whether
/// it reads well.
class GermanPicturesTest : public PicturesWindowTest {
 protected:
  void SetUp() override {
    if (std::system("command -v msgfmt >/dev/null") != 0) {
      GTEST_SKIP() << "msgfmt is not installed (Debian's gettext)";
    }
    PicturesWindowTest::SetUp();
    if (IsSkipped()) return;
    const fs::path compiled = window_->share / "languages/de/LC_MESSAGES/jnd.mo";
    fs::create_directories(compiled.parent_path());
    const std::string command = "msgfmt --output-file='" + compiled.string() + "' '" +
                                (window_->share / "data/languages/de.po").string() + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }
  void look(const std::string& name) {
    window_->resize(1024, 640);
    window_->picture(fs::path(JND_PICTURES) / ("german-" + name + "-1024x640-light.png"));
  }

  const EnvironmentVariable all_{"LC_ALL", nullptr}, messages_{"LC_MESSAGES", nullptr};
  const EnvironmentVariable language_{"LANGUAGE", nullptr}, lang_{"LANG", "de_DE.UTF-8"};
};

TEST_F(GermanPicturesTest, OfEveryViewOutsideOfSessions) {
  ASSERT_EQ(jnd({"simulate", "viscosity_discrimination", "--participants", "3", "--fast",
                 "--study", path("three.study").string()})
                .exit_code,
            0);
  window_->start();
  window_->wait_for_view("start");
  window_->wait_for_text("Dieser Rechner");
  look("start");
  window_->press("F1");
  window_->wait_for("keys_close");
  look("keys");
  window_->press("F1");
  window_->use("new_study");
  window_->wait_for("new_folder");
  look("start-new");
  window_->press("F2");
  window_->use("device");
  window_->wait_for_view("device");
  window_->wait_for("change_device");
  look("device");
  window_->use("page_daily");
  look("device-daily");
  window_->use("page_force");
  look("device-force");
  window_->use("tab_start");
  window_->use("open_data");
  window_->wait_for("open_path");
  write_file(path("order.csv"),
             "condition,delay_ms,num_first,num_asked\nlight,-90,2,40\nlight,-30,12,40\n"
             "light,0,20,40\nlight,30,30,40\nlight,90,38,40\nsound,-90,1,20\nsound,-30,3,20\n"
             "sound,0,6,20\nsound,30,12,20\nsound,90,19,20\n");
  window_->press("ctrl+a");
  window_->type(path("order.csv").string());
  window_->press("Return");
  window_->wait_for("page_curves");
  look("data-table");
  window_->use("page_curves");
  window_->wait_for("group_2");
  look("data-curves");
  window_->use("page_comparison");
  window_->wait_for_text("Holm");
  look("data-comparison");
  window_->use("tab_start");
  window_->use("open_study");
  window_->wait_for("open_path");
  look("start-open");
  window_->press("ctrl+a");
  window_->type(path("three.study").string());
  window_->press("Return");
  window_->wait_for_view("sessions");
  look("sessions");
  window_->use("tab_study");
  window_->wait_for_view("study");
  look("study");
  window_->use("tab_results");
  const Screen results = window_->wait_for("export");
  for (const Screen::Widget& widget : results.widgets) {
    if (!widget.name.starts_with("page_")) continue;
    window_->use(widget.name);
    look("results-" + widget.name.substr(5));
  }
  close();
}

TEST_F(GermanPicturesTest, OfASession) {
  window_->start({"run", "viscosity_discrimination", "--study", path("one.study").string(),
                  "--participant", "P01", "--device", "lumped", "--seed", "7"});
  window_->wait_for_view("prepare");
  window_->wait_for("start_session");
  look("prepare");
  window_->use("start_session");
  window_->wait_for("begin");
  look("session-begin");
  window_->use("begin");
  window_->wait_for("item_done");
  look("session-checklist");
  window_->press("F4");
  window_->wait_for("camera_above");
  look("session-apparatus");
  window_->press("F4");
  window_->use("pause");
  window_->wait_for("reason_1");
  look("session-pause");
  window_->press("2");
  window_->press("Escape");
  window_->wait_for_text("Notaus");
  look("session-stop");
  window_->kill();
}

}  // namespace german_pictures_test
}  // namespace jnd::app
