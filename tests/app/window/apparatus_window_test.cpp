#include <gmock/gmock.h>

#include <cmath>
#include <map>

#include "app/window/pictures_fixture.h"
#include "app/window/window_studies.h"

namespace jnd::app {
namespace apparatus_window_test {

namespace fs = std::filesystem;

class ApparatusWindowTest : public PicturesWindowTest {
 protected:
  /// Presents the test of the first trial and opens the view of the apparatus.
  void look_at_apparatus(const std::string& device) {
    write_file(path("study.json"), study_of(kComparison));
    window_->start({"run", path("study.json").string(), "--study", path("a.study").string(),
                    "--participant", "P01", "--device", device, "--seed", "7"});
    window_->use("start_session");
    window_->use("begin");
    feel_test();
    window_->use("apparatus");
    window_->wait_for_view("apparatus");
    window_->wait_for_text("picture of the apparatus");
  }
  /// Returns how many colours the picture has. A picture without any apparatus has one.
  std::size_t num_colours_of_scene(const std::string& name) {
    const fs::path file = path(name + ".png");
    window_->picture(file);
    const Screen now = window_->wait_for("scene");
    const Screen::Widget& scene = *now.find("scene");
    const std::string part = std::to_string(scene.width - 8) + "x" +
                             std::to_string(scene.height - 8) + "+" +
                             std::to_string(scene.x + 4) + "+" + std::to_string(scene.y + 4);
    const ToolOutcome pixels = run_tool(
        {"convert", file.string(), "-crop", part, "-depth", "8", "gray:-"}, display_->name());
    std::map<char, int> shades;
    for (const char pixel : pixels.out) ++shades[pixel];
    return shades.size();
  }
};

TEST_F(ApparatusWindowTest, IsSeenAndTurnedWhileItsScopesRunAndLeftByItsKey) {
  look_at_apparatus("lumped");
  EXPECT_GT(num_colours_of_scene("first"), 20U) << "surface and hand are in the picture";
  const std::string at_first = read_file(path("first.png"));
  window_->use("camera_above");
  EXPECT_GT(num_colours_of_scene("above"), 20U);
  EXPECT_NE(read_file(path("above.png")), at_first);

  window_->use("scope_2");
  window_->wait_for("channel_typed");
  window_->type("thumb force x");
  window_->wait_for("channel_thumb_force_x_n");
  window_->press("Return");
  window_->wait_for_text("thumb force x · N");

  window_->use("apparatus");
  window_->wait_for_view("session");
  // If the machine took too long for the first picture, the heartbeat was lost, and the
  // stimulus is presented again.
  window_->wait_until("the trial goes on", [](const Screen& now) {
    return now.find("answer_yes") != nullptr || now.find("present") != nullptr;
  });
  window_->kill();
}

TEST_F(ApparatusWindowTest, EscapeStopsTheForceFromHereToo) {
  look_at_apparatus("lumped");
  window_->press("Escape");
  window_->wait_for_text("F4: where it is armed again");
  EXPECT_EQ(window_->screen().view, "apparatus");
  window_->use("apparatus");
  window_->wait_for("release_stop");
  window_->kill();
}

TEST_F(ApparatusWindowTest, PicturesOfTheExoskeletonLightAndDark) {
  look_at_apparatus("exoskeleton");
  window_->wait_until(
      "ten seconds of scopes", [began = std::chrono::steady_clock::now()](const Screen&) {
        return std::chrono::steady_clock::now() - began > std::chrono::seconds(10);
      });
  take("apparatus");
  window_->use("scope_4");
  window_->wait_for("channel_typed");
  window_->type("index rad");
  take("apparatus-channels");
  window_->kill();
}

TEST_F(ApparatusWindowTest, OfADoubleBlindStudyNothingIsShown) {
  write_file(path("study.json"), study_of(kComparison, "double"));
  window_->start({"run", path("study.json").string(), "--study", path("a.study").string(),
                  "--participant", "P01", "--device", "lumped", "--seed", "7"});
  window_->use("start_session");
  window_->use("begin");
  feel_test();
  window_->use("apparatus");
  window_->wait_for_text("This study is double-blind");
  const Screen now = window_->wait_for_view("apparatus");
  EXPECT_EQ(now.find("scene"), nullptr);
  EXPECT_EQ(now.find("scope_1"), nullptr);
  EXPECT_EQ(window_->every_text().find("picture of the apparatus"), std::string::npos);
  take("apparatus-blind", 1);
  window_->kill();
}

}  // namespace apparatus_window_test
}  // namespace jnd::app
