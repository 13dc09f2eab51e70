#include <gtest/gtest.h>

#include <cmath>

#include "analysis/results/study_results.h"
#include "app/operator/operated_session_fixture.h"
#include "app/session/replay_check.h"
#include "app/session/session_batch.h"
#include "app/session/session_setup.h"
#include "app/tiny_study.h"
#include "core/storage/integrity.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/session/session.h"

namespace jnd::app {
namespace matching_run_test {

using namespace experiments;

/// A study of six trials, in which a fluid with the drag of a sphere is matched by one with the
/// drag of a hand.
const std::string kMatchingStudy = R"json({
  "format": 1, "name": "matching", "languages": ["en"], "title": {"en": "Matching"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "block", "name": "match", "procedure": "matching", "medium": "viscous",
     "viscosity_pa_s": [2, 9], "standard_medium": "viscous_stokes",
     "standard_viscosity_pa_s": [4, 8, 12], "repetitions": 1,
     "coarse_step_viscosity_pa_s": 1, "fine_step_viscosity_pa_s": 0.25,
     "max_viscosity_pa_s": 20, "instruction": {"en": "Set it."},
     "question": {"en": "Alike?"}, "free_space_between_s": 0, "expected_trial_s": 20}]
})json";

class MatchingRun : public ::testing::Test {
 protected:
  MatchingRun() {
    laboratory_.arm.home_s = 0.1;
    for (auto& [procedure, strokes] : laboratory_.strokes) {
      strokes.amplitude_m = 0.05;
      strokes.strokes_per_presentation = 1;
    }
    sessions_ = add_sessions(store_,
                             {.study = study_,
                              .laboratory = &laboratory_,
                              .study_file = "matching.json",
                              .seed = 3,
                              .record = false},
                             {"P01", "P02"});
    run_batch({.study = study_,
               .laboratory = laboratory_,
               .store = store_,
               .sessions = sessions_,
               .jobs = 1});
  }

  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
  Study study_ = read_study_text(kMatchingStudy, "matching.json");
  Laboratory laboratory_ = thesis_laboratory();
  core::StudyStore store_{temporary_.path() / "a.study", core::StudyStore::Mode::kCreate,
                          core::Durability::kAtClose};
  std::vector<std::int64_t> sessions_;
};

TEST_F(MatchingRun, TheSamePersonsMatchAlikeWithAndWithoutADevice) {
  const AnswerSimulator simulator(study_, laboratory_);
  for (const std::int64_t session : sessions_) {
    const auto trials = store_.trials(session);
    const auto calculated = simulator.answers(stages_of(study_, cells_of(study_).front()),
                                              store_.session(session).seed);
    ASSERT_EQ(trials.size(), 6U);
    for (std::size_t i = 0; i < trials.size(); ++i) {
      const AnsweredTrial& alone = calculated.front().trials[i];
      EXPECT_EQ(trials[i].reference_intensity, alone.planned.reference_intensity);
      EXPECT_EQ(trials[i].starting_intensity, alone.planned.starting_intensity);
      EXPECT_NEAR(*trials[i].response, *alone.response, 0.25 + 1e-9) << "at most a fine step";
    }
  }
}

TEST_F(MatchingRun, TheStandardIsRenderedInItsOwnMedium) {
  for (const core::PresentationRow& row : store_.presentations(sessions_.front())) {
    // The drag constants of a sphere and of a hand, in metres.
    const double constant = row.interval == "reference" ? 1.2322 : 1.7760;
    EXPECT_NEAR(row.measures.commanded_damping_n_s_per_m.value(), constant * row.intensity,
                1e-3 * row.intensity);
  }
}

TEST_F(MatchingRun, VerifiesAndHasResults) {
  core::Integrity integrity = core::verify(store_);
  check_replay(store_, integrity);
  EXPECT_TRUE(integrity.complete);
  const analysis::StudyResults results =
      analysis::results_of(analysis::load_study(store_), {}, {.num_resamples = 50});
  const analysis::Estimate* match = results.find("match.match_at_8");
  ASSERT_NE(match, nullptr);
  EXPECT_NEAR(std::log(match->value.value() / (8.0 * 1.2322 / 1.7760)), 0.0, 0.5);
  EXPECT_NE(results.find("match.ratio_to_standard"), nullptr) << "both are in Pa s";
}

/// Runs the same study with a person at the window.
class MatchingAtTheWindow : public OperatedSessionTest {};

TEST_F(MatchingAtTheWindow, TheStandardComesFirstThenStepsAndSwitchesUntilItMatches) {
  open(kMatchingStudy);
  SessionView now = run_to_block("match");
  const std::int64_t trial = now.trial->trial;
  EXPECT_TRUE(now.trial->adjustable);
  EXPECT_TRUE(now.trial->has_reference);
  EXPECT_NE(now.trial->level.find("reference viscous stokes"), std::string::npos)
      << now.trial->level;
  EXPECT_NE(act(operate::Present{trial, "test"}).refusal, "") << "the standard comes first";
  act(operate::Present{trial, "reference"});
  pass(0.5);
  EXPECT_NE(act(operate::Adjust{trial, Direction::kRaise, StepSize::kFine}).refusal, "")
      << "the standard is nobody's to adjust";
  act(operate::Present{trial, "test"});
  pass(0.5);
  EXPECT_EQ(act(operate::Adjust{trial, Direction::kRaise, StepSize::kFine}).refusal, "");
  pass(0.5);
  act(operate::Present{trial, "reference"});
  pass(0.5);
  act(operate::Present{trial, "test"});
  pass(0.5);
  EXPECT_EQ(act(operate::Answer{trial, 0.0}).refusal, "");
  const core::TrialRow row = store_->trials(session_number_).front();
  EXPECT_EQ(row.response, *row.starting_intensity + 0.25);
  EXPECT_EQ(row.num_presentations, 5);
}

TEST_F(MatchingAtTheWindow, NothingMatchesWhileTheStandardIsFelt) {
  open(kMatchingStudy);
  const std::int64_t trial = run_to_block("match").trial->trial;
  act(operate::Present{trial, "reference"});
  pass(0.5);
  act(operate::Present{trial, "test"});
  pass(0.5);
  act(operate::Present{trial, "reference"});
  pass(0.5);
  EXPECT_NE(act(operate::Answer{trial, 0.0}).refusal, "");
  EXPECT_TRUE(store_->trials(session_number_).empty());
}

}  // namespace matching_run_test
}  // namespace jnd::app
