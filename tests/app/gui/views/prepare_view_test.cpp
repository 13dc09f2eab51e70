#include "app/gui/views/prepare_view.h"

#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/study_fixtures.h"

namespace jnd::app::gui {
namespace prepare_view_test {

using Status = PreflightLine::Status;

class PrepareViewTest : public ::testing::Test {
 protected:
  PrepareViewTest() {
    model_.devices = {{"lumped", "a simulated hand", true}, {"mouse", "a drawn hand", true}};
    model_.languages = {"en", "de"};
    model_.taken = {"P01", "P02"};
    model_.assigned = "low, then high";
    model_.seed = 4711;
    model_.lines = {{"Disk", Status::kOk, "80 GB free", ""},
                    {"Loop", Status::kWarning, "3 ticks missed", "close other programs"}};
  }

  PrepareViewResult draw() {
    PrepareViewResult all;
    ui_.frame([&](Ui& now) {
      const PrepareViewResult result = draw_prepare_view(now, model_, state_);
      if (result.tab != StudyTab::kNone) all.tab = result.tab;
      all.start |= result.start;
      all.look_again |= result.look_again;
      all.fields_changed |= result.fields_changed;
    });
    return all;
  }
  PrepareViewResult after_key(const Chord& key) {
    (void)draw();
    ui_.press(key);
    return draw();
  }

  StudyFolder study_ = some_study();
  PrepareModel model_{.study = study_};
  PrepareViewState state_{.participant = "P04", .device = "lumped", .language = "en"};
  HeadlessUi ui_;
};

TEST_F(PrepareViewTest, AWarningForbidsNothing) {
  EXPECT_TRUE(after_key({Key::kEnter}).start);
  for (const char* words : {"P04", "low, then high", "4711", "80 GB free", "3 ticks missed",
                            "close other programs"}) {
    EXPECT_TRUE(ui_.drawn().shows(words) || state_.participant == words) << words;
  }
}

TEST_F(PrepareViewTest, HowTheDeviceWasFittedIsWrittenAsPairsOrNotAtAll) {
  EXPECT_TRUE(after_key({Key::kEnter}).start) << "it may be left empty";
  state_.fitting = "glove M";
  EXPECT_FALSE(after_key({Key::kEnter}).start);
  EXPECT_TRUE(ui_.drawn().shows("Fitting: write glove=M"));
  state_.fitting = "glove=M, thumb = thin pad";
  EXPECT_TRUE(after_key({Key::kEnter}).start);
}

TEST_F(PrepareViewTest, ASimulatedDeviceNeverStartsAsARealSession) {
  model_.devices.push_back({"delta", "a real one", false});
  choose_kind(model_, state_);
  EXPECT_TRUE(state_.pilot);
  (void)draw();
  EXPECT_TRUE(ui_.drawn().shows("Marked for good, left out of results."));
  EXPECT_FALSE(ui_.drawn().shows("Its answers are data"));
  (void)after_key({letter('3')});
  EXPECT_EQ(state_.device, "delta");
  EXPECT_FALSE(state_.pilot) << "a person's hand is in it";
  (void)after_key({letter('1')});
  EXPECT_TRUE(state_.pilot) << "and back";
}

TEST_F(PrepareViewTest, WhatAPersonChoseStaysAndSaysWhatItMeans) {
  choose_kind(model_, state_);
  (void)after_key({letter('R')});
  EXPECT_FALSE(state_.pilot);
  (void)draw();
  EXPECT_TRUE(ui_.drawn().shows("Its answers are data, though the device is simulated."));
  (void)after_key({letter('2')});
  EXPECT_FALSE(state_.pilot) << "chosen, it stays";
}

TEST_F(PrepareViewTest, AFailureForbidsAndIsNamed) {
  model_.lines[0].status = Status::kFailed;
  EXPECT_FALSE(after_key({Key::kEnter}).start);
  EXPECT_FALSE(ui_.drawn().find("start_session")->enabled);
  EXPECT_TRUE(ui_.drawn().shows("To be mended first: Disk."));
}

TEST_F(PrepareViewTest, NothingStartsBeforeEverythingWasLookedAt) {
  model_.lines[1].status = Status::kWaiting;
  model_.looking = true;
  EXPECT_FALSE(after_key({Key::kEnter}).start);
  EXPECT_TRUE(ui_.drawn().shows("Still looking"));
  model_.lines.clear();
  model_.looking = false;
  EXPECT_FALSE(after_key({Key::kEnter}).start);
}

TEST_F(PrepareViewTest, AParticipantIsOneThatNobodyWasYet) {
  for (const char* wrong : {"", "P01", "a b", "Müller", "x/y"}) {
    state_.participant = wrong;
    EXPECT_FALSE(after_key({Key::kEnter}).start) << wrong;
  }
  state_.participant = std::string(65, 'x');
  EXPECT_FALSE(after_key({Key::kEnter}).start);
  state_.participant = "pilot_7-b.2";
  EXPECT_TRUE(after_key({Key::kEnter}).start);
}

TEST_F(PrepareViewTest, ANameLikeAnotherIsAskedAboutAndMayStart) {
  state_.participant = "p1";
  (void)draw();
  EXPECT_TRUE(ui_.drawn().shows("Another person than P01, who has taken part?"));
  EXPECT_TRUE(after_key({Key::kEnter}).start);
}

TEST_F(PrepareViewTest, EnterInTheNameStartsToo) {
  (void)draw();
  ui_.click("participant");
  (void)draw();
  ui_.type("5");
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw().start);
  EXPECT_NE(state_.participant.find('5'), std::string::npos);
  EXPECT_EQ(state_.device, "lumped") << "a digit that is typed chooses no device";
}

TEST_F(PrepareViewTest, AnotherDeviceIsLookedAtAgain) {
  EXPECT_TRUE(after_key({letter('2')}).look_again);
  EXPECT_EQ(state_.device, "mouse");
  EXPECT_FALSE(after_key({letter('2')}).look_again) << "the same one is not";
  EXPECT_TRUE(after_key({.key = letter('L'), .control = true}).look_again);
}

TEST_F(PrepareViewTest, PilotAndLanguageAreChosenByTheirKeys) {
  (void)after_key({letter('P')});
  EXPECT_TRUE(state_.pilot);
  EXPECT_TRUE(ui_.drawn().shows("left out of results"));
  (void)after_key({letter('R')});
  EXPECT_FALSE(state_.pilot);
  (void)after_key({letter('L')});
  EXPECT_EQ(state_.language, "de");
  (void)after_key({letter('L')});
  EXPECT_EQ(state_.language, "en");
}

TEST_F(PrepareViewTest, ADoubleBlindOrderIsNotShownWhateverTheModelHolds) {
  study_.blinding = experiments::Blinding::kDouble;
  study_.hides_levels = true;
  (void)draw();
  EXPECT_FALSE(ui_.drawn().shows("low"));
  EXPECT_TRUE(ui_.drawn().shows("hidden"));
}

TEST_F(PrepareViewTest, WhatTheStudyStratifiesByIsAskedBeforeTheStart) {
  model_.fields = {{.name = "handedness",
                    .question = {{"en", "Which hand?"}, {"de", "Welche Hand?"}},
                    .options = {{"right", {{"en", "right hand"}, {"de", "rechts"}}},
                                {"left", {{"en", "left hand"}, {"de", "links"}}}}}};
  model_.assigned = "";
  EXPECT_FALSE(after_key({Key::kEnter}).start);
  EXPECT_TRUE(ui_.drawn().shows("Choose first: Which hand?"));
  EXPECT_TRUE(ui_.drawn().shows("Order: as chosen below."));
  EXPECT_TRUE(after_key({letter('F')}).fields_changed);
  EXPECT_EQ(state_.fields.at("handedness"), "right");
  EXPECT_TRUE(after_key({letter('F')}).fields_changed);
  EXPECT_EQ(state_.fields.at("handedness"), "left");
  EXPECT_TRUE(after_key({Key::kEnter}).start);
}

}  // namespace prepare_view_test
}  // namespace jnd::app::gui
