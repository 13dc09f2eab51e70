#include "experiments/participants/answer_simulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "experiments/participants/median_person.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/session/plan.h"
#include "experiments/session/session.h"
#include "support/places.h"

namespace jnd::experiments {
namespace answer_simulator_test {

const std::string kSource = test_support::source_folder().string();

Study study(const char* name) { return read_study(kSource + "/protocols/" + name + ".json"); }

TEST(AnswerSimulator, AsksInTheOrderThatASessionOfTheSameSeedWouldDraw) {
  for (const char* name : {"viscosity_discrimination", "magnitude_of_virtual_water"}) {
    const Study here = study(name);
    const Laboratory there = thesis_laboratory();
    const AnswerSimulator simulator(here, there);
    for (const ParticipantPlan& plan :
         plan_participants(here, {.participants = {"P01", "P02"}, .seed = 4})) {
      const auto answered =
          simulator.answers(plan.stages, session_seed(4, here.name, plan.participant));
      ASSERT_EQ(answered.size(), plan.blocks.size());
      for (std::size_t block = 0; block < answered.size(); ++block) {
        EXPECT_EQ(answered[block].stage, plan.blocks[block].stage);
        ASSERT_EQ(answered[block].trials.size(), plan.blocks[block].trials.size());
        for (std::size_t trial = 0; trial < answered[block].trials.size(); ++trial) {
          const PlannedTrial& asked = answered[block].trials[trial].planned;
          const PlannedTrial& planned = plan.blocks[block].trials[trial];
          EXPECT_EQ(asked.intensity, planned.intensity);
          EXPECT_EQ(asked.starting_intensity, planned.starting_intensity);
          EXPECT_EQ(asked.target_percent, planned.target_percent);
        }
      }
    }
  }
}

TEST(AnswerSimulator, IsAFunctionOfTheSeedAlone) {
  const Study here = study("magnitude_of_virtual_water");
  const Laboratory there = thesis_laboratory();
  const AnswerSimulator simulator(here, there), other(here, there);
  const auto stages = stages_of(here, cells_of(here).front());
  const auto responses = [&](const AnswerSimulator& by, std::uint64_t seed) {
    std::vector<double> all;
    for (const AnsweredBlock& block : by.answers(stages, seed)) {
      for (const AnsweredTrial& trial : block.trials) all.push_back(*trial.response);
    }
    return all;
  };
  const auto first = responses(simulator, 1);
  (void)simulator.answers(stages, 2);
  EXPECT_EQ(responses(simulator, 1), first);
  EXPECT_EQ(responses(other, 1), first);
  EXPECT_NE(responses(simulator, 2), first);
}

TEST(AnswerSimulator, APerfectObserverIsRightAboutEveryStimulus) {
  const Study here = study("viscosity_discrimination");
  const Laboratory quiet = without_noise(thesis_laboratory());
  const AnswerSimulator simulator(here, quiet);
  for (const AnsweredBlock& block :
       simulator.answers(stages_of(here, cells_of(here).front()), 1)) {
    for (const AnsweredTrial& trial : block.trials) {
      EXPECT_EQ(trial.response, *trial.planned.intensity > *trial.planned.reference_intensity);
    }
  }
}

TEST(AnswerSimulator, PeopleSayThickerOneWeberFractionAboveTheReferenceAsOftenAsTheModelHasIt) {
  // There is only reading noise, so 84.13 % say thicker at reference (1 + w).
  Laboratory plain = without_noise(thesis_laboratory());
  plain.perceiver.weber_fraction = 0.152;
  Study here = study("viscosity_discrimination");
  const Cell cell = cells_of(here).front();
  std::vector<StageInstance> stages = stages_of(here, cell);
  std::vector<Stage> own;
  own.reserve(stages.size());
  for (StageInstance& instance : stages) {
    own.push_back(*instance.stage);
    instance.stage = &own.back();
    auto* block = std::get_if<Block>(&own.back().content);
    if (block == nullptr) continue;
    block->intensities = {*block->reference_intensity *
                          (1.0 + median_weber_fraction(plain, *block))};
    block->repetitions = 20000;
  }
  const AnswerSimulator simulator(here, plain);
  for (const AnsweredBlock& block : simulator.answers(stages, 1)) {
    double yes = 0.0;
    for (const AnsweredTrial& trial : block.trials) yes += *trial.response;
    EXPECT_NEAR(yes / 20000.0, 0.8413, 4.0 * std::sqrt(0.8413 * 0.1587 / 20000.0))
        << block.stage->name;
  }
}

TEST(AnswerSimulator, ProductionsLieOnTheStepsAndApproachTheTarget) {
  const Study here = study("magnitude_of_virtual_water");
  const Laboratory there = thesis_laboratory();
  const AnswerSimulator simulator(here, there);
  std::map<double, double> sums;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    for (const AnsweredBlock& block :
         simulator.answers(stages_of(here, cells_of(here).front()), seed)) {
      const auto& content = std::get<Block>(block.stage->content);
      if (content.procedure != "magnitude_production") continue;
      for (const AnsweredTrial& trial : block.trials) {
        const double steps =
            (*trial.response - *trial.planned.starting_intensity) / content.fine_step;
        if (trial.response > 0.0) {
          EXPECT_NEAR(steps, std::round(steps), 1e-9);
        }
        sums[*trial.planned.target_percent] += *trial.response;
      }
    }
  }
  EXPECT_LT(sums.at(50), sums.at(100));
  EXPECT_LT(sums.at(100), sums.at(200));
}

TEST(MedianPerson, TheWeberFractionGrowsByTheShareOfTheDevice) {
  const Laboratory there = thesis_laboratory();
  for (const Stage& stage : study("viscosity_discrimination").stages) {
    const auto* several = std::get_if<Counterbalance>(&stage.content);
    if (several == nullptr) continue;
    for (const Counterbalance::Arm& arm : several->arms) {
      const auto& block = std::get<Block>(arm.stages.front().content);
      // The expected value is w0 (1 + b / (c reference)), with c = 1.776 m.
      EXPECT_NEAR(median_weber_fraction(there, block),
                  0.152 * (1.0 + 4.83 / (1.776 * *block.reference_intensity)), 1e-9);
      Laboratory ideal = there;
      ideal.device.mechanical_viscosity_n_s_per_m = 0.0;
      EXPECT_NEAR(median_weber_fraction(ideal, block), 0.152, 1e-9);
      // The step down follows from c x = (c reference + b) / (1 + w0) - b.
      const double reference = *block.reference_intensity;
      const double down = ((1.776 * reference + 4.83) / 1.152 - 4.83) / 1.776;
      const double up = 1.0 + median_weber_fraction(there, block);
      EXPECT_GT(reference / down, up) << "the device hides what becomes less";
      EXPECT_NEAR(median_curve_fraction(there, block), std::sqrt(up * reference / down) - 1.0,
                  1e-9);
      EXPECT_NEAR(median_curve_fraction(ideal, block), 0.152, 1e-9);
      // If the fluid is so thin that even no fluid is not that much less, only the step up
      // counts.
      Block thin = block;
      thin.reference_intensity = 0.1;
      EXPECT_EQ(median_curve_fraction(there, thin), median_weber_fraction(there, thin));
    }
  }
}

}  // namespace answer_simulator_test
}  // namespace jnd::experiments
