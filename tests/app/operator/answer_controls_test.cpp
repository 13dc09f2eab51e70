#include "app/operator/answer_controls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/operator/kept_controls.h"
#include "app/tiny_study.h"
#include "core/controls/piped_device.h"
#include "core/error.h"
#include "support/comes_about.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace answer_controls_test {

namespace fs = std::filesystem;
using test_support::comes_about;
using ::testing::HasSubstr;

/// Imitates a window with one pedal, which is a pipe.
class AnswerControlsTest : public ::testing::Test {
 protected:
  ~AnswerControlsTest() override { controls_.reset(); }

  void open() {
    controls_ = std::make_unique<AnswerControls>(AnswerControls::Parameters{
        .file = file_,
        .reader = {.folder = temporary_.path() / "input",
                   .open = [this](const fs::path&) { return pedal_.open(); }},
        .press_stop = [this] { ++num_stops_; },
        .wake = [this] { ++num_wakes_; }});
  }
  void SetUp() override {
    fs::create_directory(temporary_.path() / "input");
    std::ofstream(temporary_.path() / "input" / "event0") << "";
    open();
  }
  void begin_session() {
    controls_->begin_session([this](const operate::UseControl& use) {
      const std::lock_guard guard(mutex_);
      used_.push_back(use);
    });
    ASSERT_TRUE(comes_about([&] { return pedal_.is_ours.load(); }));
  }
  [[nodiscard]] std::vector<operate::UseControl> used() {
    const std::lock_guard guard(mutex_);
    return used_;
  }
  [[nodiscard]] static core::Control key(const std::string& name) {
    return {"0c45:7403 pedal", name};
  }
  [[nodiscard]] PreflightLine line(bool participant_answers = false) const {
    return *controls_line(controls_->map(), controls_->devices(), participant_answers);
  }

  test_support::TemporaryFolder temporary_;
  fs::path file_ = temporary_.path() / "config" / "jnd" / "controls.json";
  core::PipedDevice pedal_{"0c45:7403 pedal"};
  std::mutex mutex_;
  std::vector<operate::UseControl> used_;
  std::atomic<int> num_stops_{0}, num_wakes_{0};
  std::unique_ptr<AnswerControls> controls_;
};

TEST_F(AnswerControlsTest, APressComesToTheSessionWithItsActionAndItsTime) {
  controls_->set("first", key("KEY_B"));
  begin_session();
  pedal_.key(KEY_B, true, 5'000'000'000);
  pedal_.key(KEY_B, false, 5'100'000'000);
  pedal_.key(KEY_C, true);
  pedal_.key(KEY_B, true, 6'000'000'000);
  ASSERT_TRUE(comes_about([&] { return used().size() == 2; }));
  EXPECT_EQ(used()[0].action, "first");
  EXPECT_EQ(used()[0].control, "0c45:7403 pedal/KEY_B");
  EXPECT_EQ(used()[0].pressed_ns, 5'000'000'000);
  controls_->end_session();
  ASSERT_TRUE(comes_about([&] { return pedal_.num_open == 0; }));
  EXPECT_EQ(num_stops_, 0);
  EXPECT_GT(num_wakes_, 0);
}

TEST_F(AnswerControlsTest, TheMapIsKeptOnTheMachine) {
  controls_->set("first", key("KEY_B"));
  controls_->set("stop", key("KEY_S"));
  open();
  EXPECT_EQ(controls_->map().action_of(key("KEY_B")), "first");
  EXPECT_EQ(controls_->words().at("stop"), "pedal: S");
  controls_->forget("first");
  open();
  EXPECT_EQ(controls_->map().rows().size(), 1U);
  for (const char* damaged :
       {"", "{", "[]", R"({"controls": 7})", R"({"controls": [7, {}]})",
        R"({"controls": [{"action": "fly", "device": "a", "control": "b"}]})"}) {
    write_file(file_, damaged);
    EXPECT_TRUE(kept_controls(file_).rows().empty()) << damaged;
  }
  fs::remove_all(file_.parent_path());
  write_file(file_.parent_path(), "a file where the folder should be");
  EXPECT_THROW(controls_->set("yes", key("KEY_Y")), core::Error);
  EXPECT_EQ(controls_->map().action_of(key("KEY_Y")), "yes") << "it holds all the same";
}

TEST_F(AnswerControlsTest, AMappedStopStopsPastEverything) {
  controls_->set("stop", key("KEY_S"));
  begin_session();
  pedal_.key(KEY_S, true);
  ASSERT_TRUE(comes_about([&] { return num_stops_ == 1; }));
  pedal_.key(KEY_S, false);
  pedal_.key(KEY_B, true);
  ASSERT_TRUE(comes_about([&] { return controls_->take_events().size() > 0; }));
  EXPECT_EQ(num_stops_, 1);
  EXPECT_TRUE(used().empty());
  EXPECT_FALSE(controls_->is_let_go());
}

// A device that is taken exclusively types nowhere, so its Escape would be lost.
TEST_F(AnswerControlsTest, EscapeOfADeviceThatIsOursStaysTheStop) {
  controls_->set("first", key("KEY_B"));
  begin_session();
  pedal_.key(KEY_ESC, true);
  EXPECT_TRUE(comes_about([&] { return num_stops_ == 1; }));
}

TEST_F(AnswerControlsTest, WhatHasToBeHeldStopsWhenItIsLetGo) {
  controls_->set("hold", key("KEY_H"));
  EXPECT_TRUE(controls_->is_let_go()) << "nobody holds it yet";
  begin_session();
  pedal_.key(KEY_H, true);
  ASSERT_TRUE(comes_about([&] { return !controls_->is_let_go(); }));
  EXPECT_EQ(num_stops_, 0);
  pedal_.key(KEY_H, false);
  ASSERT_TRUE(comes_about([&] { return num_stops_ == 1; }));
  EXPECT_TRUE(controls_->is_let_go());
}

TEST_F(AnswerControlsTest, AStopThatIsUnpluggedStops) {
  controls_->set("stop", key("KEY_S"));
  begin_session();
  pedal_.unplug();
  EXPECT_TRUE(comes_about([&] { return num_stops_ == 1; }));
}

TEST_F(AnswerControlsTest, AnAnswerThatIsUnpluggedStopsNobody) {
  controls_->set("first", key("KEY_B"));
  begin_session();
  pedal_.unplug();
  ASSERT_TRUE(comes_about([&] { return pedal_.num_open == 0; }));
  EXPECT_EQ(num_stops_, 0);
}

TEST_F(AnswerControlsTest, WithoutASessionAStopIsToldToTheWindow) {
  controls_->set("stop", key("KEY_S"));
  controls_->prepare(true);
  ASSERT_TRUE(comes_about([&] { return pedal_.is_ours.load(); }));
  pedal_.key(KEY_S, true);
  ASSERT_TRUE(comes_about([&] { return controls_->take_stop(); }));
  EXPECT_FALSE(controls_->take_stop());
  EXPECT_EQ(num_stops_, 0);
}

TEST_F(AnswerControlsTest, TheLookBeforeASessionSaysWhatIsMissing) {
  using Status = PreflightLine::Status;
  EXPECT_FALSE(controls_line(controls_->map(), {}, false)) << "nothing is asked for";
  EXPECT_EQ(line(true).status, Status::kWarning);
  EXPECT_THAT(line(true).remedy, HasSubstr("answered by the participant"));
  controls_->set("first", key("KEY_B"));
  EXPECT_EQ(line().status, Status::kWarning);
  EXPECT_THAT(line().remedy, HasSubstr("plug it in: pedal: B"));
  controls_->prepare(true);
  ASSERT_TRUE(comes_about([&] { return line().status == Status::kOk; }));
  EXPECT_EQ(line(true).status, Status::kOk);
  controls_->set("stop", {"another pedal", "KEY_S"});
  EXPECT_EQ(line().status, Status::kFailed) << "nobody could stop";
  EXPECT_THAT(line().remedy, HasSubstr("another pedal: S"));
}

}  // namespace answer_controls_test
}  // namespace jnd::app
