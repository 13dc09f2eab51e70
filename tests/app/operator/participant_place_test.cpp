#include "app/operator/participant_place.h"

#include <gtest/gtest.h>

#include <iterator>

#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace participant_place_test {

namespace fs = std::filesystem;
using Where = ScreenChoice::Where;

const Monitor kOurs{.name = "DP-1", .width_px = 2560, .height_px = 1440, .has_window = true};
const Monitor kTheirs{.name = "HDMI-1", .x_px = 2560, .width_px = 1920, .height_px = 1080};
const ScreenChoice kOnTheirs{.where = Where::kMonitor, .monitor = "HDMI-1"};

TEST(ParticipantPlace, IsRememberedByTheNameOfTheMonitor) {
  const test_support::TemporaryFolder temporary;
  const fs::path folder = temporary.path() / "state" / "jnd";
  EXPECT_EQ(remembered_screen(folder), ScreenChoice{});
  for (const ScreenChoice& choice :
       {kOnTheirs, ScreenChoice{.where = Where::kWindow},
        ScreenChoice{.where = Where::kMonitor, .monitor = "Dell Inc. DELL U2415 (7)"}}) {
    remember_screen(folder, choice);
    EXPECT_EQ(remembered_screen(folder), choice);
  }
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1)
      << "nothing lies beside it";
  remember_screen(folder, {});
  EXPECT_EQ(remembered_screen(folder), ScreenChoice{});
}

TEST(ParticipantPlace, IsOffWhereTheFileHoldsAnythingElse) {
  const test_support::TemporaryFolder temporary;
  for (const std::string& wrong :
       {std::string(), std::string("\n"), std::string("windows"), std::string("monitor"),
        std::string("monitor \n"), std::string("monitor a\0b", 11),
        "monitor " + std::string(129, 'a')}) {
    test_support::write_file(temporary.path() / "participant_screen", wrong);
    EXPECT_EQ(remembered_screen(temporary.path()), ScreenChoice{}) << wrong;
  }
  remember_screen(temporary.path(), {.where = Where::kMonitor, .monitor = "a\nb"});
  EXPECT_EQ(remembered_screen(temporary.path()), ScreenChoice{}) << "no name of a monitor";
  remember_screen("", kOnTheirs);
  remember_screen("/proc/no/such/folder", kOnTheirs);
  EXPECT_EQ(remembered_screen(""), ScreenChoice{});
}

TEST(ParticipantPlace, IsTheChosenMonitorWhileItIsPluggedIn) {
  EXPECT_TRUE(place_of_screen({}, {kOurs, kTheirs}).nowhere);
  ScreenPlace place = place_of_screen(kOnTheirs, {kOurs, kTheirs});
  EXPECT_FALSE(place.nowhere);
  EXPECT_EQ(place.monitor, "HDMI-1");
  EXPECT_EQ(place.problem, "");
  place = place_of_screen(kOnTheirs, {kOurs});
  EXPECT_TRUE(place.nowhere);
  EXPECT_NE(place.problem.find("HDMI-1 is not plugged in"), std::string::npos);
  EXPECT_TRUE(place_of_screen(kOnTheirs, {}).nowhere);
}

TEST(ParticipantPlace, IsNeverTheMonitorThatTheExperimentersWindowIsOn) {
  const ScreenPlace place =
      place_of_screen({.where = Where::kMonitor, .monitor = "DP-1"}, {kOurs, kTheirs});
  EXPECT_TRUE(place.nowhere);
  EXPECT_NE(place.problem.find("This window is on DP-1"), std::string::npos);
  for (const ScreenOption& option : screen_options({}, {kOurs, kTheirs})) {
    EXPECT_NE(option.choice.monitor, "DP-1");
  }
}

TEST(ParticipantPlace, IsChosenAmongTheOtherMonitorsOrBesideWhereThereIsNone) {
  std::vector<ScreenOption> options = screen_options({}, {kOurs, kTheirs});
  ASSERT_EQ(options.size(), 2U);
  EXPECT_EQ(options[0].choice, ScreenChoice{});
  EXPECT_EQ(options[1].choice, kOnTheirs);
  EXPECT_EQ(options[1].label, "HDMI-1");
  EXPECT_EQ(options[1].kind, "1920 × 1080");
  options = screen_options({}, {kOurs});
  ASSERT_EQ(options.size(), 2U);
  EXPECT_EQ(options[1].choice.where, Where::kWindow);
  // The saved choice stays in the list, although its monitor is missing.
  options = screen_options(kOnTheirs, {kOurs});
  ASSERT_EQ(options.size(), 3U);
  EXPECT_EQ(options[1].choice, kOnTheirs);
  EXPECT_EQ(options[1].kind, "not plugged in");
}

TEST(ParticipantPlace, MonitorsAreReadLineByLine) {
  const test_support::TemporaryFolder temporary;
  const fs::path file = temporary.path() / "monitors";
  EXPECT_TRUE(told_monitors(file).empty());
  test_support::write_file(file,
                           "left 0 0 1280 720\nwrong 1 2\n\nnone 0 0 0 0\nright 1280 -8 "
                           "1024 600\n");
  const std::vector<Monitor> expected = {
      {.name = "left", .width_px = 1280, .height_px = 720},
      {.name = "right", .x_px = 1280, .y_px = -8, .width_px = 1024, .height_px = 600}};
  EXPECT_EQ(told_monitors(file), expected);
}

}  // namespace participant_place_test
}  // namespace jnd::app
