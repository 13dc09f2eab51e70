#include <gtest/gtest.h>

#include <cmath>

#include "analysis/results/study_results.h"
#include "app/operator/operated_session_fixture.h"
#include "app/session/replay_check.h"
#include "app/session/session_batch.h"
#include "app/session/session_setup.h"
#include "app/session/stability_limits.h"
#include "core/storage/integrity.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/session/plan.h"
#include "experiments/session/session.h"
#include "support/sanitizer.h"

namespace jnd::app {
namespace solid_run_test {

using namespace experiments;

const std::string kSolidStudy = R"json({
  "format": 1, "name": "stiffness", "languages": ["en"], "title": {"en": "Stiffness"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "block", "name": "stiff", "procedure": "constant_stimuli", "medium": "solid",
     "stiffness_n_per_m": [200, 300, 533, 800], "reference_stiffness_n_per_m": 400,
     "repetitions": 3, "instruction": {"en": "Press."}, "question": {"en": "Stiffer?"},
     "expected_trial_s": 15}]
})json";

Study study() { return read_study_text(kSolidStudy, "solid.json"); }

class SolidRun : public ::testing::Test {
 protected:
  void simulate() {
    laboratory_.arm.home_s = 0.1;
    sessions_ = add_sessions(store_,
                             {.study = study_,
                              .laboratory = &laboratory_,
                              .study_file = "solid.json",
                              .seed = 3,
                              .record = false},
                             {"P01", "P02", "P03"});
    run_batch({.study = study_,
               .laboratory = laboratory_,
               .store = store_,
               .sessions = sessions_,
               .jobs = 1});
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  Study study_ = study();
  Laboratory laboratory_ = thesis_laboratory();
  core::StudyStore store_{temporary_.path() / "a.study", core::StudyStore::Mode::kCreate,
                          core::Durability::kAtClose};
  std::vector<std::int64_t> sessions_;
};

TEST_F(SolidRun, TheSamePersonsAnswerAlikeWithAndWithoutADevice) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  simulate();
  const AnswerSimulator simulator(study_, laboratory_);
  int num_alike = 0, num_trials = 0;
  for (const std::int64_t session : sessions_) {
    const auto calculated = simulator.answers(stages_of(study_, cells_of(study_).front()),
                                              store_.session(session).seed);
    const auto trials = store_.trials(session);
    ASSERT_EQ(trials.size(), 12U);
    for (std::size_t i = 0; i < trials.size(); ++i) {
      EXPECT_EQ(trials[i].intensity, calculated.front().trials[i].planned.intensity);
      num_alike += trials[i].response == calculated.front().trials[i].response ? 1 : 0;
      ++num_trials;
    }
  }
  EXPECT_GE(num_alike, num_trials - 2);
}

TEST_F(SolidRun, APressIsNoStroke) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  simulate();
  for (const core::PresentationRow& row : store_.presentations(sessions_.front())) {
    EXPECT_EQ(row.measures.num_strokes, 0);
    EXPECT_FALSE(row.measures.stroke_width_m);
    EXPECT_FALSE(row.measures.delivered_damping_n_s_per_m);
    EXPECT_EQ(row.measures.limited_ticks, 0) << "the limiter kept out of the way";
  }
  const analysis::StudyResults results =
      analysis::results_of(analysis::load_study(store_), {}, {.num_resamples = 50});
  EXPECT_EQ(results.find("stroke_width_m"), nullptr);
  bool says_so = false;
  for (const analysis::ResultsSection& section : results.sections) {
    for (const analysis::ExcludedParticipant& one : section.excluded) {
      says_so = says_so || one.reason.find("a solid is pressed") != std::string::npos;
    }
  }
  EXPECT_TRUE(says_so);
}

TEST_F(SolidRun, VerifiesAndHasAWeberFraction) {
  simulate();
  core::Integrity integrity = core::verify(store_);
  check_replay(store_, integrity);
  EXPECT_TRUE(integrity.complete);
  const analysis::StudyResults results =
      analysis::results_of(analysis::load_study(store_), {}, {.num_resamples = 50});
  const analysis::Estimate* w = results.find("stiff.weber_fraction");
  ASSERT_NE(w, nullptr);
  EXPECT_NEAR(w->value.value(), 0.23, 0.2) << "36 answers";
}

TEST(SolidPreflight, WhatTheDeviceCannotRenderStablyIsTold) {
  const auto map = shipped_stability_map("exoskeleton");
  ASSERT_TRUE(map);
  Study stiff = study();
  auto& block = std::get<Block>(stiff.stages.front().content);
  block.intensities.push_back(90000.0);
  const auto check = check_stability(*map, stiff, planned_range(stiff, {}), 0.5);
  ASSERT_TRUE(check);
  EXPECT_EQ(check->num_unstable(), 1);
}

class SolidAtTheWindow : public OperatedSessionTest {};

TEST_F(SolidAtTheWindow, ASurfaceIsPresentedNotAFluid) {
  open(kSolidStudy);
  SessionView now = run_to_block("stiff");
  EXPECT_TRUE(now.trial->is_solid);
  act(operate::Present{now.trial->trial, "reference"});
  pass(1.0);
  EXPECT_TRUE(view().surroundings.surface_is_solid);
  now = act(operate::Present{now.trial->trial, "test"});
  EXPECT_EQ(now.heading, "Test surface");
  EXPECT_NE(now.trial->level.find("N/m"), std::string::npos);
  pass(1.0);
  EXPECT_EQ(act(operate::Answer{now.trial->trial, 1.0}).refusal, "");
  act(operate::Undo{"again"});
  answer_trial(view(), 0.0);
  EXPECT_EQ(store_->trials(session_number_).front().attempt, 2);
}

}  // namespace solid_run_test
}  // namespace jnd::app
