#include "app/session/presenter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <variant>
#include <vector>

#include "app/tiny_study.h"
#include "core/media/medium.h"
#include "core/random_stream.h"
#include "experiments/participants/laboratory.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"

namespace jnd::app {
namespace presenter_test {

/// A log that stores nothing and delays the beginning of a presentation.
class SlowLog final : public experiments::EventLog {
 public:
  void append(const core::Commit& commit) override {
    num_without_force += commit.event.kind == "force_missing" ? 1 : 0;
    if (commit.event.kind == "presentation_started") std::this_thread::sleep_for(delay);
  }
  std::chrono::milliseconds delay{0};
  int num_without_force = 0;
};

/// A presenter in a block, that of comparisons unless a test says otherwise, with its first
/// trial under way.
class PresenterTest : public ::testing::Test {
 protected:
  void start(bool realtime) {
    Apparatus::Parameters parameters;
    parameters.realtime = realtime;
    parameters.allow_no_realtime = true;
    apparatus_ = std::make_unique<Apparatus>(parameters, laboratory_);
    session_ = std::make_unique<experiments::Session>(
        experiments::Session::Parameters{.session = 1, .seed = 7, .stages = {&stage()}},
        std::vector<core::EventRow>{}, log_, apparatus_->clock());
    presenter_ = std::make_unique<Presenter>(*apparatus_, *session_, study_.device);
    session_->start();
    session_->enter_stage();
    session_->start_trial(apparatus_->next_tick());
  }
  [[nodiscard]] const experiments::Stage& stage() const {
    return *std::ranges::find(study_.stages, block_, &experiments::Stage::name);
  }
  void begin() {
    presenter_->begin(std::get<experiments::Block>(stage().content), "reference");
  }

  /// A step of the stimulus that is adjusted, over its ramp and as long as this.
  void feel_step(Presenter::Beginning beginning, double duration_s) {
    presenter_->begin(std::get<experiments::Block>(stage().content), "test", beginning);
    apparatus_->run_for(study_.device.ramp_s);
    presenter_->ramp_is_over();
    apparatus_->run_for(duration_s);
  }
  void adjust() {
    using experiments::Direction;
    const experiments::StepSize size = experiments::StepSize::kFine;
    const bool can_rise = session_->can_adjust(Direction::kRaise, size);
    ASSERT_TRUE(session_->adjust(can_rise ? Direction::kRaise : Direction::kLower, size));
  }

  std::string block_ = "comparison";
  experiments::Study study_ = experiments::read_study_text(kTinyStudy, "tiny.json");
  experiments::Laboratory laboratory_ = experiments::thesis_laboratory();
  SlowLog log_;
  std::unique_ptr<Apparatus> apparatus_;
  std::unique_ptr<experiments::Session> session_;
  std::unique_ptr<Presenter> presenter_;
};

TEST_F(PresenterTest, TheRampCountsFromTheMediumAndNotFromTheCommitBeforeIt) {
  // A heartbeat may be silent for longer than this.
  log_.delay = std::chrono::milliseconds(150);
  start(/*realtime=*/true);
  apparatus_->run_for(0.01);
  begin();
  while (!presenter_->ramp_has_passed()) apparatus_->run_for(0.001);
  const core::Telemetry then = apparatus_->telemetry();
  EXPECT_EQ(then.command_sequence, 1U) << "the medium is in force";
  EXPECT_TRUE(then.ramp_finished);
  EXPECT_GE(presenter_->felt_s(), study_.device.ramp_s);
}

TEST_F(PresenterTest, WithoutRealTimeTheRampTakesItsTicksAndNoneMore) {
  start(/*realtime=*/false);
  begin();
  apparatus_->run_for(study_.device.ramp_s - 0.001);
  EXPECT_FALSE(presenter_->ramp_has_passed());
  apparatus_->run_for(0.001);
  EXPECT_TRUE(presenter_->ramp_has_passed());
  EXPECT_TRUE(presenter_->waits_for_ramp());
  presenter_->ramp_is_over();
  EXPECT_FALSE(presenter_->waits_for_ramp());
}

TEST_F(PresenterTest, APresentationThatEndsInFreeSpaceCountsToTheTickBefore) {
  start(/*realtime=*/false);
  begin();
  apparatus_->begin_strokes({}, core::RandomStream(1, "stroke"));
  apparatus_->run_for(study_.device.ramp_s);
  presenter_->ramp_is_over();
  apparatus_->run_for(3.0);
  const std::int64_t next_tick = apparatus_->next_tick();
  const Presenter::Felt felt = presenter_->end(Presenter::Afterwards::kFreeSpace);
  EXPECT_EQ(felt.last_tick, next_tick - 1);
  EXPECT_GT(felt.delivered_damping_n_s_per_m, 0.0);
  apparatus_->run_for(0.1);
  EXPECT_EQ(apparatus_->telemetry().total_force_n, core::PlainVector{});
  EXPECT_FALSE(presenter_->under_way());
}

TEST_F(PresenterTest, AHandThatRestsBetweenTwoStepsMissesNoForceIfItMovesInOthers) {
  block_ = "production";
  start(/*realtime=*/false);
  feel_step(Presenter::Beginning::kStimulus, 1.0);
  presenter_->end(Presenter::Afterwards::kNextStep);
  adjust();
  apparatus_->begin_strokes({}, core::RandomStream(1, "stroke"));
  feel_step(Presenter::Beginning::kStep, 3.0);
  presenter_->end(Presenter::Afterwards::kFreeSpace);
  EXPECT_EQ(log_.num_without_force, 0);
}

TEST_F(PresenterTest, AStimulusOfTwoStepsWithoutForceIsToldOfOnce) {
  block_ = "production";
  start(/*realtime=*/false);
  feel_step(Presenter::Beginning::kStimulus, 1.0);
  presenter_->end(Presenter::Afterwards::kNextStep);
  adjust();
  feel_step(Presenter::Beginning::kStep, 1.0);
  presenter_->end();
  EXPECT_EQ(log_.num_without_force, 1);
  adjust();
  feel_step(Presenter::Beginning::kStep, 1.0);
  presenter_->end(Presenter::Afterwards::kFreeSpace);
  EXPECT_EQ(log_.num_without_force, 1) << "it is the same stimulus";
}

}  // namespace presenter_test
}  // namespace jnd::app
