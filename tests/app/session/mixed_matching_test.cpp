#include <gtest/gtest.h>

#include <cmath>

#include "app/session/laboratory_run.h"
#include "app/session/session_setup.h"
#include "core/storage/integrity.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "support/temporary_folder.h"

// Tests a fluid that is adjusted until it feels as strong as a solid, and the reverse.

namespace jnd::app {
namespace mixed_matching_test {

const std::string kFluidToSolid = R"json({
  "format": 1, "name": "mixed", "languages": ["en"], "title": {"en": "Mixed"},
  "authors": ["A. Author"],
  "device": {"min_contact_points": 1, "rate_hz": 1000, "ramp_s": 0.05},
  "stages": [{"kind": "block", "name": "as_strong", "procedure": "matching",
    "medium": "viscous", "viscosity_pa_s": [1, 10],
    "standard_medium": "solid", "standard_stiffness_n_per_m": [150, 600],
    "coarse_step_viscosity_pa_s": 1, "fine_step_viscosity_pa_s": 0.2, "max_viscosity_pa_s": 40,
    "repetitions": 2, "instruction": {"en": "Adjust."}, "question": {"en": "As strong?"},
    "expected_trial_s": 30}]})json";

experiments::Laboratory steady_laboratory() {
  experiments::Laboratory laboratory = experiments::thesis_laboratory();
  laboratory.perceiver.lapse_rate = 0.0;
  laboratory.perceiver.anchor_ratio = 0.0;
  laboratory.perceiver.criterion_sd_ln = 0.0;
  laboratory.perceiver.weber_fraction = 0.02;
  laboratory.perceiver.weber_fraction_sd_ln = 0.0;
  laboratory.pressing->weber_fraction = 0.02;
  laboratory.pressing->weber_fraction_sd_ln = 0.0;
  return laboratory;
}

/// Returns the match that a person of `laboratory` feels to be as strong: the same multiple of
/// the stimulus whose strength counts as 1.
double expected_match(const experiments::Laboratory& laboratory, double stiffness_n_per_m) {
  constexpr double kDampingOfPaS = 1.776;
  return stiffness_n_per_m / laboratory.pressing->standard_stiffness_n_per_m *
         laboratory.perceiver.standard_damping_n_s_per_m / kDampingOfPaS;
}

TEST(MatchingAFluidToASolid, IsAcceptedAndSetToWhatFeelsAsStrong) {
  const experiments::Study study = experiments::read_study_text(kFluidToSolid, "study.json");
  const experiments::Laboratory laboratory = steady_laboratory();
  const experiments::AnswerSimulator simulator(study, laboratory);
  const auto blocks =
      simulator.answers(stages_of(study, experiments::cells_of(study).front()), 5);
  ASSERT_EQ(blocks.front().trials.size(), 8U);
  for (const experiments::AnsweredTrial& trial : blocks.front().trials) {
    const double expected =
        expected_match(laboratory, trial.planned.reference_intensity.value());
    EXPECT_NEAR(std::log(*trial.response / expected), 0.0, 0.25)
        << *trial.response << " for " << *trial.planned.reference_intensity;
  }
}

TEST(MatchingAFluidToASolid, IsRunAtTheDeviceWithBothKindsOfTouch) {
  const experiments::Study study = experiments::read_study_text(kFluidToSolid, "study.json");
  const experiments::Laboratory laboratory = steady_laboratory();
  test_support::TemporaryFolder temporary{test_support::memory_folder()};
  core::StudyStore store(temporary.path() / "a.study", core::StudyStore::Mode::kCreate,
                         core::Durability::kAtClose);
  (void)add_sessions(store,
                     {.study = study,
                      .laboratory = &laboratory,
                      .study_file = "study.json",
                      .seed = 5,
                      .record = false},
                     {"P01"});
  EXPECT_TRUE(run_laboratory({.study = study,
                              .laboratory = laboratory,
                              .store = store,
                              .session = 1,
                              .durability = core::Durability::kAtClose})
                  .ended);
  EXPECT_TRUE(core::verify(store).complete);
  double sum_ln = 0.0;
  const std::vector<core::TrialRow> trials = store.trials(1);
  ASSERT_EQ(trials.size(), 8U);
  for (const core::TrialRow& trial : trials) {
    EXPECT_GT(trial.response.value(), 0.0);
    sum_ln +=
        std::log(*trial.response / expected_match(laboratory, *trial.reference_intensity));
  }
  EXPECT_NEAR(sum_ln / 8.0, 0.0, 0.3) << "the device delivers a little less of a stiffness";
}

}  // namespace mixed_matching_test
}  // namespace jnd::app
