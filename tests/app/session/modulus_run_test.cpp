#include <gtest/gtest.h>

#include "analysis/results/study_results.h"
#include "app/operator/operated_session_fixture.h"
#include "app/session/replay_check.h"
#include "app/session/session_batch.h"
#include "app/session/session_setup.h"
#include "core/storage/integrity.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/session/session.h"

namespace jnd::app {
namespace modulus_run_test {

using namespace experiments;

/// A study in which a standard is felt in every second trial, and people choose their own
/// numbers.
const std::string kModulusStudy = R"json({
  "format": 1, "name": "modulus", "languages": ["en"], "title": {"en": "Modulus"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [
    {"kind": "block", "name": "to_standard", "procedure": "magnitude_estimation",
     "medium": "viscous", "viscosity_pa_s": [4, 16], "repetitions": 2, "modulus": "standard",
     "standard_medium": "viscous_stokes", "standard_viscosity_pa_s": [8],
     "standard_every_trials": 2, "modulus_value": 10, "instruction": {"en": "Say."},
     "question": {"en": "How thick?"}, "expected_trial_s": 15},
    {"kind": "block", "name": "free", "procedure": "magnitude_estimation",
     "medium": "viscous", "viscosity_pa_s": [4, 16], "repetitions": 2, "modulus": "free",
     "instruction": {"en": "Say any number."}, "question": {"en": "How thick?"},
     "expected_trial_s": 15}]
})json";

TEST(ModulusRun, VerifiesAndHasResults) {
  const test_support::TemporaryFolder temporary(test_support::memory_folder());
  const Study study = read_study_text(kModulusStudy, "modulus.json");
  const Laboratory laboratory = thesis_laboratory();
  core::StudyStore store(temporary.path() / "a.study", core::StudyStore::Mode::kCreate,
                         core::Durability::kAtClose);
  const auto sessions = add_sessions(store,
                                     {.study = study,
                                      .laboratory = &laboratory,
                                      .study_file = "modulus.json",
                                      .seed = 4,
                                      .record = false},
                                     {"P01", "P02"});
  run_batch({.study = study,
             .laboratory = laboratory,
             .store = store,
             .sessions = sessions,
             .jobs = 1});
  core::Integrity integrity = core::verify(store);
  check_replay(store, integrity);
  EXPECT_TRUE(integrity.complete);
  int num_standards = 0;
  for (const core::PresentationRow& row : store.presentations(sessions.front())) {
    if (row.interval != "reference") continue;
    ++num_standards;
    EXPECT_NEAR(row.measures.commanded_damping_n_s_per_m.value(), 1.2322 * 8.0, 0.01);
  }
  EXPECT_GE(num_standards, 2) << "two trials of four, and looks again";
  const analysis::StudyResults results =
      analysis::results_of(analysis::load_study(store), {}, {.num_resamples = 50});
  EXPECT_TRUE(results.find("to_standard.a")->value);
  EXPECT_TRUE(results.find("free.a")->value);
}

class ModulusAtTheWindow : public OperatedSessionTest {};

TEST_F(ModulusAtTheWindow, TheStandardIsAskedForWhereItIsDueAndSaysItsNumber) {
  open(kModulusStudy);
  SessionView now = run_to_block("to_standard");
  EXPECT_TRUE(now.trial->has_reference);
  EXPECT_EQ(now.trial->answer, AnswerKind::kNumber);
  EXPECT_NE(act(operate::Present{now.trial->trial, "test"}).refusal, "");
  now = act(operate::Present{now.trial->trial, "reference"});
  EXPECT_EQ(now.say, "= 10");
  EXPECT_EQ(now.participant_text, "= 10");
  pass(0.5);
  act(operate::Present{now.trial->trial, "test"});
  pass(0.5);
  EXPECT_NE(act(operate::Answer{now.trial->trial, 0.0}).refusal, "") << "0 is no ratio";
  EXPECT_EQ(act(operate::Answer{now.trial->trial, 15.0}).refusal, "");
  now = view();
  EXPECT_FALSE(now.trial->has_reference) << "every second trial";
  EXPECT_EQ(now.answers.front().answer, "15");
  act(operate::Present{now.trial->trial, "test"});
  pass(0.5);
  EXPECT_EQ(act(operate::Answer{now.trial->trial, 7.5}).refusal, "");
}

TEST_F(ModulusAtTheWindow, AnAnswerIsSetRightAboveZeroAlone) {
  open(kModulusStudy);
  const SessionView now = run_to_block("free");
  const std::int64_t trial = now.trial->trial;
  act(operate::Present{trial, "test"});
  pass(0.5);
  act(operate::Answer{trial, 1234.0});
  EXPECT_NE(act(operate::Correct{trial, 0.0, "misheard"}).refusal, "");
  EXPECT_EQ(act(operate::Correct{trial, 12.0, "misheard"}).refusal, "");
  EXPECT_EQ(act(operate::Undo{"again"}).refusal, "");
  EXPECT_EQ(view().trial->trial, trial);
  EXPECT_EQ(view().trial->attempt, 1);
}

TEST_F(ModulusAtTheWindow, ResumedItGoesOnWithTheSameStandards) {
  open(kModulusStudy);
  const SessionView now = run_to_block("to_standard");
  answer_trial(now, 12.0);
  act(operate::Leave{""});
  reopen();
  act(operate::Begin{"repeat"});
  EXPECT_FALSE(view().trial->has_reference);
  act(operate::Pause{"a moment"});
  EXPECT_EQ(view().step, Step::kPaused);
}

}  // namespace modulus_run_test
}  // namespace jnd::app
