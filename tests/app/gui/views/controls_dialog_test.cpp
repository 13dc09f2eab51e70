#include "app/gui/views/controls_dialog.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

#include "app/gui/headless_ui.h"

namespace jnd::app::gui {
namespace controls_dialog_test {

const core::Control kLeft{"0c45:7403 FootSwitch", "KEY_A"};
const core::Control kRight{"0c45:7403 FootSwitch", "KEY_B"};

std::int64_t steady_ns() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

class ControlsDialogTest : public ::testing::Test {
 protected:
  /// Draws a frame in which these controls were pressed or released, and does what the dialog
  /// requests.
  ControlsResult draw(std::vector<core::ControlEvent> events = {}) {
    ControlsResult all;
    ui_.frame([&](Ui& ui) {
      const auto pressed = take_presses(state_, std::exchange(events, {}), devices_);
      const ControlsResult result = draw_controls_dialog(ui, map_, devices_, pressed, state_);
      if (result.mapped) map_.set(result.mapped->first, result.mapped->second);
      if (result.forgotten) map_.forget(*result.forgotten);
      all.is_closed |= result.is_closed;
    });
    return all;
  }
  ControlsResult after_key(Key key) {
    ui_.press(key);
    return draw();
  }
  static core::ControlEvent press(const core::Control& control, bool is_down = true) {
    return {control, is_down, steady_ns()};
  }

  core::ControlMap map_;
  std::vector<core::ControlReader::DeviceState> devices_ = {{.device = kLeft.device}};
  ControlsState state_{.is_open = true};
  HeadlessUi ui_;
};

TEST_F(ControlsDialogTest, WhatIsPressedNextIsMapped) {
  (void)draw({press(kRight), press(kRight, false)});
  EXPECT_TRUE(map_.rows().empty()) << "nobody has asked for it";
  EXPECT_TRUE(ui_.drawn().shows("Pressed last: FootSwitch: B"));
  after_key(Key::kEnter);
  EXPECT_TRUE(ui_.drawn().shows("Press the pedal or the button for “The first interval”"));
  (void)draw({press(kLeft)});
  EXPECT_EQ(map_.action_of(kLeft), "first");
  EXPECT_TRUE(ui_.drawn().shows("FootSwitch: A"));
  (void)draw({press(kLeft, false), press(kRight)});
  EXPECT_EQ(map_.action_of(kRight), "") << "one press, one mapping";
  after_key(Key::kDown);
  after_key(Key::kEnter);
  (void)draw({press(kRight)});
  EXPECT_EQ(map_.action_of(kRight), "second");
}

// The Enter that starts the assignment is also a key of a keyboard that the dialog listens to.
TEST_F(ControlsDialogTest, WhatWasPressedBeforeIsNotMeant) {
  (void)draw();
  const core::ControlEvent before = press(kLeft);
  after_key(Key::kEnter);
  (void)draw({before});
  EXPECT_TRUE(map_.rows().empty());
  EXPECT_TRUE(state_.waits);
  after_key(Key::kF2);
  (void)draw({press(kLeft)});
  EXPECT_TRUE(map_.rows().empty()) << "left as it was";
}

TEST_F(ControlsDialogTest, AWholeKeyboardIsAskedAbout) {
  devices_[0].is_keyboard = true;
  (void)draw();
  after_key(Key::kEnter);
  (void)draw({press(kLeft)});
  EXPECT_TRUE(map_.rows().empty());
  EXPECT_TRUE(ui_.drawn().shows("has the keys of a whole keyboard"));
  after_key(Key::kF2);
  EXPECT_FALSE(state_.asks_about);
  after_key(Key::kEnter);
  (void)draw({press(kLeft)});
  after_key(Key::kEnter);
  EXPECT_EQ(map_.action_of(kLeft), "first");
}

TEST_F(ControlsDialogTest, ALineIsForgottenAndTheDialogLeft) {
  map_.set("first", kLeft);
  (void)draw();
  EXPECT_TRUE(ui_.drawn().find("control_forget")->enabled);
  after_key(Key::kDelete);
  EXPECT_TRUE(map_.rows().empty());
  EXPECT_FALSE(ui_.drawn().find("control_forget")->enabled);
  ui_.click("control_stop");
  (void)draw();
  EXPECT_EQ(core::kControlActions[state_.chosen], "stop");
  EXPECT_TRUE(after_key(Key::kF2).is_closed);
}

TEST_F(ControlsDialogTest, SaysOfEachDeviceWhetherItCanBeUsed) {
  devices_.push_back({.device = "/dev/input/event3", .problem = "join the group input"});
  (void)draw();
  EXPECT_TRUE(ui_.drawn().shows("listened to"));
  EXPECT_TRUE(ui_.drawn().shows("join the group input"));
  devices_.clear();
  (void)draw();
  EXPECT_TRUE(ui_.drawn().shows("Nothing that can be read"));
}

}  // namespace controls_dialog_test
}  // namespace jnd::app::gui
