#include "app/gui/views/bench_view.h"

#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/bench_picture.h"

namespace jnd::app::gui {
namespace bench_view_test {

using Act = DeviceQuestion::Act;
using Page = BenchViewState::Page;

class BenchViewTest : public ::testing::Test {
 protected:
  BenchViewTest() {
    device_.name = "plugin:arm:real";
    device_.is_known = true;
    device_.profile = {.name = "Profile",
                       .status = PreflightLine::Status::kFailed,
                       .found = "no force: it has no profile",
                       .remedy = "measure it"};
    device_.facts = {{"Model", "arm"}};
    for (double x : {-0.1, 0.1}) {
      for (double y : {-0.1, 0.1}) {
        for (double z : {-0.25, -0.05}) device_.marks_m.emplace_back(x, y, z);
      }
    }
    device_.daily_marks_m = {device_.marks_m[0], device_.marks_m[3], device_.marks_m[5],
                             device_.marks_m[6]};
    for (std::size_t i = 0; i < device_.steps.size(); ++i) {
      device_.steps[i].title = "Step " + std::to_string(i + 1);
      device_.steps[i].waits = i > 1;
    }
    device_.next_step = 0;
    device_.record = "arm.commissioning.jsonl";
  }
  BenchViewResult draw(HeadlessUi& ui) {
    BenchViewResult all;
    ui.frame([&](Ui& now) {
      const BenchViewResult one = draw_bench_view(
          now, {.device = device_, .choices = choices_, .has_study = has_study_}, state_);
      if (one.tab != StudyTab::kNone) all.tab = one.tab;
      if (one.choose) all.choose = one.choose;
      if (one.measure) all.measure = one.measure;
      if (one.undo) all.undo = one.undo;
      all.write_profile |= one.write_profile;
      all.check |= one.check;
      all.push |= one.push;
      all.watch |= one.watch;
      all.answer |= one.answer;
      all.leave_off |= one.leave_off;
      all.stop |= one.stop;
      all.release_stop |= one.release_stop;
    });
    return all;
  }
  BenchViewResult after(const Chord& key) {
    (void)draw(ui_);
    ui_.press(key);
    return draw(ui_);
  }
  void measure_up_to(std::size_t num) {
    for (std::size_t i = 0; i < num; ++i) {
      device_.steps[i].measured_at = "2026-11-25 10:12 UTC";
      device_.steps[i].found = {{"Gain", "0.902 N/N"}};
    }
    for (DeviceView::Step& step : device_.steps) step.waits = false;
    device_.next_step.reset();
    if (num < device_.steps.size()) device_.next_step = num;
  }

  DeviceView device_;
  std::vector<BenchModel::Choice> choices_ = {{"lumped", "a simulated hand", true}};
  bool has_study_ = false;
  BenchViewState state_;
  HeadlessUi ui_;
};

TEST_F(BenchViewTest, EnterMeasuresTheStepThatComesNext) {
  EXPECT_EQ(after({Key::kEnter}).measure, CommissioningStep::kHoming);
  EXPECT_TRUE(ui_.drawn().shows("no force: it has no profile"));
  measure_up_to(3);
  EXPECT_EQ(after({Key::kEnter}).measure, CommissioningStep::kForce);
}

TEST_F(BenchViewTest, AStepThatWaitsForAnotherCannotBeMeasured) {
  for (int i = 0; i < 3; ++i) (void)after({Key::kRight});
  EXPECT_FALSE(after({Key::kEnter}).measure);
  EXPECT_TRUE(ui_.drawn().shows("A step before it has to be measured first."));
}

TEST_F(BenchViewTest, AMeasuredStepShowsWhatWasFoundAndIsMeasuredAgainOrUndone) {
  measure_up_to(3);
  (void)after({Key::kLeft});
  EXPECT_TRUE(ui_.drawn().shows("0.902 N/N"));
  EXPECT_EQ(after({letter('M')}).measure, CommissioningStep::kFrame);
  EXPECT_EQ(after({letter('Z'), true}).undo, CommissioningStep::kFrame);
  EXPECT_EQ(ui_.drawn().find("write_profile"), nullptr) << "three steps are missing";
  measure_up_to(device_.steps.size());
  state_.step.reset();
  EXPECT_TRUE(after({Key::kEnter}).write_profile);
}

TEST_F(BenchViewTest, WhatIsAskedIsAnsweredByEnterOrLeftByF2) {
  device_.work = DeviceWork::kMeasuring;
  device_.working_step = 1;
  device_.question = DeviceQuestion{.act = Act::kTouch,
                                    .words = "Bring it to the mark.",
                                    .mark_m = device_.marks_m[3],
                                    .num_touched = 3};
  EXPECT_TRUE(after({Key::kEnter}).answer);
  EXPECT_TRUE(ui_.drawn().shows("Mark 4 of 8: left, far, high"));
  EXPECT_TRUE(after({Key::kF2}).leave_off);
  EXPECT_TRUE(after({Key::kEscape}).stop);
}

TEST_F(BenchViewTest, WhileItMovesNothingLeadsAwayFromTheStop) {
  has_study_ = true;
  for (const DeviceWork work : {DeviceWork::kMeasuring, DeviceWork::kChecking,
                                DeviceWork::kTryingForce, DeviceWork::kWatching}) {
    device_.work = work;
    (void)draw(ui_);
    EXPECT_EQ(ui_.drawn().find("tab_start"), nullptr);
    EXPECT_FALSE(ui_.drawn().find("change_device")->enabled);
    EXPECT_NE(ui_.drawn().find("emergency_stop"), nullptr);
  }
  device_.work = DeviceWork::kNone;
  EXPECT_EQ(after({letter('1'), true}).tab, StudyTab::kSessions);
  has_study_ = false;
  (void)draw(ui_);
  EXPECT_EQ(ui_.drawn().find("tab_sessions"), nullptr) << "it leads nowhere";
  EXPECT_NE(ui_.drawn().find("tab_start"), nullptr);
}

TEST_F(BenchViewTest, OfARealDeviceAForceIsConfirmedFirst) {
  (void)after({letter('3')});
  (void)after({letter('Z')});
  EXPECT_FALSE(after({Key::kEnter}).push);
  EXPECT_TRUE(ui_.drawn().shows("Nobody's hand is in the device"));
  EXPECT_TRUE(after({Key::kEscape}).stop) << "reached above the dialog";
  EXPECT_TRUE(after({Key::kEnter}).push);
  EXPECT_EQ(state_.axis, 2);
  (void)after({Key::kEnter});
  EXPECT_FALSE(after({Key::kF2}).push);
  device_.is_simulated = true;
  EXPECT_TRUE(after({Key::kEnter}).push) << "nobody can be hurt";
}

TEST_F(BenchViewTest, WatchingShowsWhatTheDeviceTellsUntilF2) {
  (void)after({letter('4')});
  EXPECT_TRUE(after({Key::kEnter}).watch);
  device_.work = DeviceWork::kWatching;
  device_.live = {{"Enabling switch", "open: no force"}, {"Buttons", "1 pressed"}};
  (void)draw(ui_);
  EXPECT_TRUE(ui_.drawn().shows("open: no force"));
  EXPECT_TRUE(ui_.drawn().shows("1 pressed"));
  EXPECT_TRUE(ui_.drawn().shows("has no force"));
  EXPECT_TRUE(after({Key::kF2}).leave_off);
}

TEST_F(BenchViewTest, AStopThatIsPressedIsReleasedBeforeAnythingBegins) {
  device_.stop_is_pressed = true;
  EXPECT_FALSE(after({Key::kEnter}).measure);
  EXPECT_EQ(ui_.drawn().find("measure"), nullptr);
  EXPECT_TRUE(after({letter('R')}).release_stop);
}

TEST_F(BenchViewTest, ADailyCheckNeedsAProfileAndTellsEachQuantity) {
  (void)after({letter('2')});
  EXPECT_FALSE(after({Key::kEnter}).check);
  device_.profile_file = "arm.device.json";
  EXPECT_TRUE(after({Key::kEnter}).check);
  device_.checked = {{"Gain", "0.87 to 0.93", "0.85 N/N", false}};
  (void)draw(ui_);
  EXPECT_TRUE(ui_.drawn().shows("0.87 to 0.93"));
  EXPECT_TRUE(ui_.drawn().shows("0.85 N/N"));
}

TEST_F(BenchViewTest, AnotherDeviceIsChosenFromTheListOrByItsAddress) {
  (void)after({letter('C')});
  ui_.type("network:lab");
  (void)draw(ui_);
  ui_.press(Key::kEnter);
  EXPECT_EQ(draw(ui_).choose, "network:lab");
  (void)after({letter('C')});
  EXPECT_FALSE(after({Key::kF2}).choose);
}

TEST_F(BenchViewTest, EveryPageFitsOnASmallScreen) {
  HeadlessUi small(1024, 640);
  device_.is_simulated = true;
  measure_up_to(4);
  for (const Page page : {Page::kCommission, Page::kDaily, Page::kForce, Page::kWatch}) {
    state_.page = page;
    (void)draw(small);
    for (const Drawn::Widget& widget : small.drawn().widgets) {
      EXPECT_LE(widget.place.right(), 1024.5f) << widget.name;
      EXPECT_LE(widget.place.bottom(), 640.5f) << widget.name;
      for (const Drawn::Widget& other : small.drawn().widgets) {
        if (&other == &widget) continue;
        const Rect both = widget.place.common(other.place);
        EXPECT_LT(both.width * both.height, 1.0f) << widget.name << " on " << other.name;
      }
    }
  }
}

TEST(BenchPictures, OfAQuestionShowTheMarkThatIsMeant) {
  const std::vector<Eigen::Vector3d> marks_m = {{-0.1, 0.0, 0.0}, {0.1, 0.0, 0.2}};
  const BenchPicture picture = picture_of_question(
      marks_m, {.act = Act::kTouch, .mark_m = marks_m[1], .num_touched = 1});
  EXPECT_EQ(picture.mark, 1);
  EXPECT_EQ(picture.num_touched, 1);
  EXPECT_EQ(place_words(marks_m, marks_m[0]), "left, low");
  EXPECT_EQ(picture_of_question(marks_m, {.act = Act::kHang, .load_kg = 0.2}).load, "200 g");
}

}  // namespace bench_view_test
}  // namespace jnd::app::gui
