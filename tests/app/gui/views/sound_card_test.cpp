#include "app/gui/views/sound_card.h"

#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/prepare_view.h"
#include "app/gui/views/study_fixtures.h"

namespace jnd::app::gui {
namespace sound_card_test {

class SoundCardTest : public ::testing::Test {
 protected:
  SoundCardTest() {
    model_.devices = {{"lumped", "a simulated hand", true}};
    model_.languages = {"en"};
    model_.lines = {{"Disk", PreflightLine::Status::kOk, "80 GB free", ""}};
    model_.sound = {.is_wanted = true,
                    .outputs = {{"default", "PipeWire", true}, {"plughw:CARD=USB", "", false}},
                    .levels = {"Pink noise, 65.0 dB SPL, -36.5 dB re full scale."}};
  }
  PrepareViewResult draw() {
    PrepareViewResult last;
    ui_.frame([&](Ui& now) {
      const PrepareViewResult result = draw_prepare_view(now, model_, state_);
      last.start |= result.start;
      last.sound.output_changed |= result.sound.output_changed;
      last.sound.test |= result.sound.test;
    });
    return last;
  }
  PrepareViewResult after_key(const Chord& key) {
    (void)draw();
    ui_.press(key);
    return draw();
  }

  StudyFolder study_ = some_study();
  PrepareModel model_{.study = study_};
  PrepareViewState state_{
      .participant = "P04", .device = "lumped", .language = "en", .sound_output = "default"};
  HeadlessUi ui_;
};

TEST_F(SoundCardTest, ShowsOutputsAndLevels) {
  (void)draw();
  for (const char* words : {"Sound for the participant", "default", "plughw:CARD=USB",
                            "not calibrated", "Off", "65.0 dB SPL", "Test the sound"}) {
    EXPECT_TRUE(ui_.drawn().shows(words)) << words;
  }
}

TEST_F(SoundCardTest, IsNotThereForAStudyWithoutSound) {
  model_.sound = {};
  (void)draw();
  EXPECT_FALSE(ui_.drawn().shows("Sound for the participant"));
}

TEST_F(SoundCardTest, TheKeyGoesFromOutputToOutputToOffAndBack) {
  for (const char* next : {"plughw:CARD=USB", "off", "default"}) {
    EXPECT_TRUE(after_key({letter('S')}).sound.output_changed);
    EXPECT_EQ(state_.sound_output, next);
  }
}

TEST_F(SoundCardTest, ATestIsAskedForAndEndedByTheSameKey) {
  EXPECT_TRUE(after_key({letter('T')}).sound.test);
  model_.sound.is_tested = true;
  EXPECT_TRUE(after_key({letter('T')}).sound.test);
  EXPECT_TRUE(ui_.drawn().shows("End the test"));
}

TEST_F(SoundCardTest, WhatIsRequiredAndCannotBeHeardKeepsTheSessionFromStarting) {
  model_.sound.problem = "Nothing of the study's sound will be heard.";
  EXPECT_TRUE(after_key({Key::kEnter}).start) << "it is not required";
  EXPECT_FALSE(after_key({letter('T')}).sound.test) << "there is nothing to test";
  model_.sound.is_required = true;
  EXPECT_FALSE(after_key({Key::kEnter}).start);
  EXPECT_EQ(sound_obstacle(model_.sound), model_.sound.problem);
  EXPECT_EQ(sound_line(model_.sound, "default").status, PreflightLine::Status::kFailed);
  EXPECT_EQ(sound_line(model_.sound, "default").remedy, model_.sound.problem);
  model_.sound.is_required = false;
  EXPECT_EQ(sound_line(model_.sound, "off").status, PreflightLine::Status::kWarning);
  model_.sound.problem = "";
  EXPECT_EQ(sound_line(model_.sound, "default").found, "default");
}

}  // namespace sound_card_test
}  // namespace jnd::app::gui
