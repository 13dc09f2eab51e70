#include "experiments/procedures/rating.h"

#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "experiments/participants/perceiver.h"
#include "experiments/participants/simulated_participant.h"
#include "experiments/procedures/procedure_registry.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/session_in_memory.h"
#include "tests/experiments/participants/thesis_laboratory.h"

namespace jnd::experiments {
namespace rating_test {

constexpr char kStudy[] = R"json({
  "format": 1, "name": "rated", "languages": ["en"], "title": {"en": "Rated"},
  "authors": ["A. Author"],
  "stages": [{"kind": "block", "name": "block", "procedure": "rating", "medium": "viscous",
    "viscosity_pa_s": [1, 4, 16], "repetitions": 3, "num_steps": 7,
    "low_label": {"en": "thin"}, "high_label": {"en": "thick"},
    "instruction": {"en": "Feel."}, "question": {"en": "How thick?"},
    "expected_trial_s": 5}]})json";

TEST(Rating, ShowsEveryStimulusOnceInEachRepetitionAndTakesAStepOfTheScale) {
  const Study study = read_study_text(kStudy, "study.json");
  MemoryLog log;
  const core::SimulatedClock clock;
  Session s({.session = 1, .seed = 3, .stages = {&study.stages.front()}}, {}, log, clock);
  s.start();
  s.enter_stage();
  std::map<double, int> shown;
  while (const auto trial = s.state().current_trial()) {
    ++shown[s.state().trial(*trial).planned.intensity.value()];
    s.start_trial(s.state().last_tick + 1);
    present(s, "test");
    for (const double wrong : {0.0, 8.0, 2.5})
      EXPECT_THROW(s.require_answer(wrong), core::Error);
    s.answer(7.0, {.response_time_s = 1.0}, s.state().last_tick);
  }
  EXPECT_EQ(shown, (std::map<double, int>{{1.0, 3}, {4.0, 3}, {16.0, 3}}));
  EXPECT_EQ(log.trials.size(), 9U);
  EXPECT_EQ(log.trials.back().response, 7.0);
  EXPECT_THROW(s.correct(1, 8.0, "misheard"), core::Error);
  EXPECT_NO_THROW(s.correct(1, 2.0, "misheard"));
}

TEST(Rating, ASimulatedPersonUsesTheWholeScaleOverTheRangeOfTheStimuli) {
  Laboratory laboratory = thesis_laboratory();
  laboratory.perceiver.lapse_rate = 0.0;
  laboratory.perceiver.assimilation_ratio = 0.0;
  laboratory.perceiver.shrink = 1.0;
  laboratory.perceiver.shrink_sd_ln = 0.0;
  const SimulatedParticipant person(laboratory, 5);
  const Study study = read_study_text(kStudy, "study.json");
  const Perceiver& senses = person.perceiver(std::get<Block>(study.stages.front().content));
  EXPECT_EQ(senses.rate(0.0, 7, {}, std::nullopt), 1.0);
  EXPECT_EQ(senses.rate(0.5, 7, {}, std::nullopt), 4.0);
  EXPECT_EQ(senses.rate(1.0, 7, {}, std::nullopt), 7.0);
  EXPECT_EQ(senses.rate(1.7, 7, {}, std::nullopt), 7.0) << "readings may lie beyond the range";
}

TEST(Rating, CertaintyGrowsWithTheDistanceFromTheCriterionAndTheLooks) {
  Laboratory laboratory = thesis_laboratory();
  laboratory.perceiver.lapse_rate = 0.0;
  laboratory.perceiver.criterion_sd_ln = 0.0;
  laboratory.perceiver.criterion_drift_per_trial_ln = 0.0;
  laboratory.perceiver.weber_fraction = 0.3;
  laboratory.perceiver.weber_fraction_sd_ln = 0.0;
  const SimulatedParticipant person(laboratory, 5);
  const Study study = read_study_text(kStudy, "study.json");
  const Perceiver& senses = person.perceiver(std::get<Block>(study.stages.front().content));
  const double jnd_ln = std::log(1.3);
  EXPECT_NEAR(senses.certainty_of_thicker(1.0, 1.0, 1, {}), 0.0, 1e-12);
  // One standard deviation from the criterion, 84.13 % are right, so certainty is 2 P - 1 =
  // 0.6827.
  EXPECT_NEAR(senses.certainty_of_thicker(jnd_ln, 0.0, 1, {}), 0.6827, 1e-4);
  EXPECT_NEAR(senses.certainty_of_thicker(0.0, jnd_ln, 1, {}), 0.6827, 1e-4);
  EXPECT_NEAR(senses.certainty_of_thicker(jnd_ln, 0.0, 4, {}), 0.9545, 1e-4);
  EXPECT_NEAR(senses.certainty_of_different(jnd_ln, 0.0, 1, {}), 0.0, 1e-12);
  EXPECT_NEAR(senses.certainty_of_different(0.0, 0.0, 1, {}), 0.6827, 1e-4);
  // The noise of a single reading is smaller by the root of two.
  EXPECT_NEAR(senses.certainty_of_present(2.0 * jnd_ln, 0.0, 1, {}), 0.8427, 1e-4);
}

}  // namespace rating_test
}  // namespace jnd::experiments
