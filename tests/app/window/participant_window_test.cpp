#include <gmock/gmock.h>

#include <fstream>
#include <string>

#include "app/environment.h"
#include "app/window/window_fixture.h"

// Tests the participant's window on a display of two monitors.

namespace jnd::app {
namespace participant_window_test {

namespace fs = std::filesystem;

constexpr const char* kTitle = "jnd: participant";
constexpr const char* kLeft = "LEFT 0 0 1280 720\n";
constexpr const char* kRight = "RIGHT 1280 0 1024 600\n";

class ParticipantWindowTest : public WindowTest {
 protected:
  void SetUp() override {
    WindowTest::SetUp();
    if (IsSkipped()) return;
    display_ = std::make_unique<VirtualDisplay>(2304, 720);
    window_ = std::make_unique<WindowDriver>(*display_, path("home"));
    plug_in(std::string(kLeft) + kRight);
  }
  /// Writes the file from which the program reads its monitors, because Xvfb always has one
  /// monitor.
  void plug_in(const std::string& monitors) {
    write_file(path("monitors.new"), monitors);
    fs::rename(path("monitors.new"), path("monitors"));
  }
  void begin_on_the_left() {
    prepare(kTinyStudy);
    window_->resize(1280, 720);
    window_->use("begin");
    window_->wait_for("item_done");
  }
  void wait_for_window(bool is_there) {
    window_->wait_until(is_there ? "the participant's window" : "its end",
                        [&](const Screen&) { return window_->has_window(kTitle) == is_there; });
  }
  [[nodiscard]] std::string asked(std::vector<std::string> words) const {
    words.insert(words.begin(), "xdotool");
    return run_tool(words, display_->name()).out;
  }
  /// Returns the title of the window that has the keyboard.
  [[nodiscard]] std::string has_the_keyboard() const {
    std::string name = asked({"getwindowfocus", "getwindowname"});
    return name.substr(0, name.find('\n'));
  }
  [[nodiscard]] std::string place_of_it() const {
    const std::string told =
        asked({"search", "--name", "^jnd: participant$", "getwindowgeometry", "--shell"});
    std::string place;
    for (const char* key : {"X=", "Y=", "WIDTH=", "HEIGHT="}) {
      const std::size_t at = told.find(std::string("\n") + key) + 1;
      place += told.substr(at, told.find('\n', at) - at) + " ";
    }
    return place;
  }

  // The variable is set after the fixture has made its folder and before any program starts.
  EnvironmentVariable monitors_{"JND_MONITORS", path("monitors").c_str()};
};

TEST_F(ParticipantWindowTest, FillsTheOtherMonitorAndTheExperimentersKeepsTheKeyboard) {
  begin_on_the_left();
  ASSERT_EQ(has_the_keyboard(), "jnd");
  window_->press("F9");
  EXPECT_EQ(window_->wait_for("screen_1").find("screen_1")->label, "RIGHT");
  EXPECT_EQ(window_->screen().find("screen_2"), nullptr) << "ours is none of them";
  window_->use("screen_1");
  wait_for_window(true);
  EXPECT_EQ(place_of_it(), "X=1280 Y=0 WIDTH=1024 HEIGHT=600 ");
  EXPECT_EQ(has_the_keyboard(), "jnd");
  // If something gives the keyboard to the participant's window, the window gives it back.
  (void)asked({"search", "--name", "^jnd: participant$", "windowfocus"});
  window_->wait_until("the keyboard",
                      [&](const Screen&) { return has_the_keyboard() == "jnd"; });
  window_->use("screen_close");
  window_->use("item_done");
  window_->wait_for("consent_given");
  window_->wait_until("the consent on it", [&](const Screen&) {
    return window_->every_text().find("You may stop.") != std::string::npos;
  });
  EXPECT_THAT(window_->every_text(), ::testing::HasSubstr("You agree to this:"));
  window_->kill();
}

TEST_F(ParticipantWindowTest, AMonitorThatIsUnpluggedIsToldAndTheSessionGoesOn) {
  begin_on_the_left();
  window_->press("F9");
  window_->use("screen_1");
  window_->use("screen_close");
  wait_for_window(true);
  plug_in(kLeft);
  window_->wait_for("participant_screen");
  wait_for_window(false);
  window_->use("item_done");
  window_->use("consent_given");
  window_->wait_for("feel_medium");
  window_->press("F9");
  window_->wait_for_text("RIGHT is not plugged in");
  window_->use("screen_close");
  plug_in(std::string(kLeft) + "RIGHT 1280 0 800 480\n");
  wait_for_window(true);
  EXPECT_EQ(place_of_it(), "X=1280 Y=0 WIDTH=800 HEIGHT=480 ");
  window_->wait_until("no warning",
                      [](const Screen& now) { return !now.find("participant_screen"); });
  EXPECT_EQ(has_the_keyboard(), "jnd");
  window_->use("feel_medium");
  window_->kill();
}

TEST_F(ParticipantWindowTest, IsRememberedForTheNextSession) {
  begin_on_the_left();
  window_->press("F9");
  window_->use("screen_1");
  wait_for_window(true);
  window_->kill();
  window_->start({"resume", path("a.study").string()});
  window_->resize(1280, 720);
  wait_for_window(true);
  EXPECT_EQ(place_of_it(), "X=1280 Y=0 WIDTH=1024 HEIGHT=600 ");
  window_->press("F9");
  window_->use("screen_0");
  wait_for_window(false);
  window_->kill();
  window_->start({"resume", path("a.study").string()});
  window_->wait_for("resume_repeat");
  EXPECT_FALSE(window_->has_window(kTitle));
  window_->kill();
}

TEST_F(ParticipantWindowTest, OnTheOnlyMonitorItStandsBesideAndNeverOverTheExperimenters) {
  plug_in("LEFT 0 0 2304 720\n");
  begin_on_the_left();
  window_->press("F9");
  EXPECT_EQ(window_->wait_for("screen_1").find("screen_1")->label, "A window beside this one");
  window_->use("screen_1");
  wait_for_window(true);
  const std::string place = place_of_it();
  EXPECT_TRUE(place.starts_with("X=1280 ")) << place;
  EXPECT_EQ(has_the_keyboard(), "jnd");
  window_->kill();
}

}  // namespace participant_window_test
}  // namespace jnd::app
