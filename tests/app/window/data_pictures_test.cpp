#include "app/window/pictures_fixture.h"

namespace jnd::app {
namespace data_pictures_test {

namespace fs = std::filesystem;

/// Takes pictures for somebody who has a table of answers, and neither a study nor a device.
class DataPicturesTest : public PicturesWindowTest {
 protected:
  void open(const std::string& name, const std::string& text) {
    write_file(path(name), text);
    window_->wait_for("open_path");
    window_->press("ctrl+a");
    window_->type(path(name).string());
    window_->press("Return");
    window_->wait_for_text(name);
    window_->wait_for("page_curves");
  }
};

TEST_F(DataPicturesTest, FromACsvToCurvesTheirComparisonAndTheCommand) {
  window_->start();
  window_->wait_for_view("start");
  take("data-start");
  window_->use("open_data");
  window_->wait_for_view("data");
  window_->wait_for("open_path");
  take("data-open");
  window_->press("F2");
  window_->wait_for("open_file");
  take("data-empty");
  window_->use("open_file");
  open("order.csv",
       "condition,delay_ms,num_first,num_asked\nlight,-90,2,40\nlight,-60,5,40\n"
       "light,-30,12,40\nlight,0,20,40\nlight,30,30,40\nlight,60,36,40\nlight,90,38,40\n"
       "sound,-90,1,20\nsound,-60,2,20\nsound,-30,3,20\nsound,0,6,20\nsound,30,12,20\n"
       "sound,60,16,20\nsound,90,19,20\n");
  take("data-table");
  window_->click("column_2");
  window_->wait_for("choice_6");
  take("data-role", 1);
  window_->press("F2");
  window_->use("page_curves");
  window_->wait_for("group_2");
  take("data-curves");
  window_->use("page_comparison");
  window_->wait_for_text("Holm");
  take("data-comparison");
  window_->use("page_command");
  window_->wait_for("copy_command");
  take("data-command", 1);
  window_->use("set_family");
  window_->wait_for("choice_6");
  take("data-family", 1);
  window_->press("F2");
  window_->use("set_interval");
  window_->wait_for("choice_4");
  take("data-intervals", 1);
  window_->press("2");
  window_->use("set_goodness");
  window_->wait_for("choice_3");
  take("data-goodness", 1);
  window_->press("2");
  window_->use("page_curves");
  window_->wait_for_text("by the bootstrap");
  take("data-bootstrap");
  window_->use("save_picture");
  window_->wait_for("data_typed");
  take("data-save", 1);
  window_->press("Return");
  window_->wait_for_text("The picture is in");
  EXPECT_GT(fs::file_size(path("order-curves.svg")), 5000U);
  close();
}

TEST_F(DataPicturesTest, OfManyCurvesOfAQuestionAndOfAFileThatIsNone) {
  std::string many = "participant,level,correct,n\n";
  for (int person = 1; person <= 9; ++person) {
    for (int level = 1; level <= 5; ++level) {
      const int num_right = std::min(40, 19 + person % 4 + (3 + person % 3) * (level - 1));
      many += "P" + std::to_string(person) + "," + std::to_string(level) + "," +
              std::to_string(num_right) + ",40\n";
    }
  }
  window_->start();
  window_->wait_for_view("start");
  window_->use("open_data");
  open("many.csv", many);
  window_->use("page_curves");
  window_->wait_for("task_right");
  take("data-task", 1);
  window_->use("task_right");
  window_->wait_for("group_3");
  take("data-many");
  window_->use("open_another");
  write_file(path("wrong.csv"), "level,answer\n1,yes\n2,no,no\n");
  window_->wait_for("open_path");
  window_->press("ctrl+a");
  window_->type(path("wrong.csv").string());
  window_->press("Return");
  window_->wait_for_text("expected 2 cells");
  take("data-wrong", 1);
  close();
}

}  // namespace data_pictures_test
}  // namespace jnd::app
