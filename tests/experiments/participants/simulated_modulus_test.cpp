#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "experiments/participants/abilities.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/median_person.h"
#include "experiments/participants/thesis_laboratory.h"

namespace jnd::experiments {
namespace simulated_modulus_test {

/// Returns a laboratory of people whose numbers are a power law of a viscous fluid's viscosity,
/// without any pull towards the middle.
Laboratory laboratory() {
  Laboratory laboratory = thesis_laboratory();
  laboratory.perceiver.shrink = 1.0;
  laboratory.perceiver.shrink_sd_ln = laboratory.perceiver.assimilation_ratio = 0.0;
  return laboratory;
}

Study estimation(const std::string& modulus) {
  Block block{.procedure = "magnitude_estimation",
              .medium = "viscous",
              .quantity = "viscosity_pa_s",
              .intensities = {3.0, 6.0, 12.0, 24.0},
              .repetitions = 3};
  block.settings.set("modulus", modulus);
  if (modulus == "standard") {
    block.standard_medium = "viscous";
    block.standards = {6.0};
    block.settings.set("modulus_value", 10.0);
    block.settings.set("standard_every_trials", 1.0);
  }
  Study study;
  study.name = "estimation";
  study.stages.push_back({.name = "how_thick", .content = std::move(block)});
  return study;
}

std::vector<AnsweredTrial> answers(const Study& study, const Laboratory& there,
                                   std::uint64_t seed) {
  const AnswerSimulator simulator(study, there);
  return simulator.answers(stages_of(study, cells_of(study).front()), seed).front().trials;
}

/// Returns the exponent by least squares of ln answer over ln intensity.
double exponent_of(const std::vector<AnsweredTrial>& trials) {
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  const auto n = static_cast<double>(trials.size());
  for (const AnsweredTrial& trial : trials) {
    const double at = std::log(*trial.planned.intensity), said = std::log(*trial.response);
    x += at / n;
    y += said / n;
    xx += at * at / n;
    xy += at * said / n;
  }
  return (xy - x * y) / (xx - x * x);
}

TEST(SimulatedModulus, FreeNumbersKeepTheExponentWhateverTheirSize) {
  Laboratory there = laboratory();
  there.perceiver.exponent = 0.8;
  there.perceiver.exponent_sd = 0.0;
  there.perceiver.lapse_rate = 0.0;
  const Study study = estimation("free");
  double sum = 0.0, smallest = 1e9, largest = 0.0;
  constexpr int kPeople = 60;
  for (std::uint64_t seed = 1; seed <= kPeople; ++seed) {
    const auto trials = answers(study, there, seed);
    sum += exponent_of(trials);
    smallest = std::min(smallest, *trials.front().response);
    largest = std::max(largest, *trials.front().response);
  }
  // A reading of the total damping has an error of 0.1, and of the fluid's own damping up to
  // twice that.
  EXPECT_NEAR(sum / kPeople, 0.8, 0.05);
  EXPECT_GT(largest, 10.0 * smallest) << "people count in numbers of their own";
}

TEST(SimulatedModulus, APersonsNumbersAreTheirModulusTimesTheRatioToWater) {
  const Laboratory quiet = without_noise(laboratory());
  const auto free = answers(estimation("free"), quiet, 1);
  const auto percent = answers(estimation("water_is_100"), quiet, 1);
  const double own = draw_person(quiet, 1).free_modulus;
  for (std::size_t i = 0; i < free.size(); ++i) {
    EXPECT_NEAR(std::log(*free[i].response / (own * *percent[i].response / 100.0)), 0.0, 0.06)
        << "but for round numbers";
  }
}

TEST(SimulatedModulus, TheStandardItselfGetsItsNumber) {
  const Laboratory quiet = without_noise(laboratory());
  for (const AnsweredTrial& trial : answers(estimation("standard"), quiet, 1)) {
    if (*trial.planned.intensity == 6.0) {
      EXPECT_DOUBLE_EQ(*trial.response, 10.0);
    }
    if (*trial.planned.intensity == 12.0) {
      EXPECT_GT(trial.response, 15.0);
    }
  }
}

TEST(SimulatedModulus, AStandardThatWasFeltBeforeIsRemembered) {
  const Laboratory quiet = without_noise(laboratory());
  Study study = estimation("standard");
  std::get<Block>(study.stages.front().content).settings.set("standard_every_trials", 12.0);
  for (const AnsweredTrial& trial : answers(study, quiet, 1)) {
    if (*trial.planned.intensity == 6.0) {
      EXPECT_DOUBLE_EQ(*trial.response, 10.0);
    }
  }
}

TEST(SimulatedModulus, IsRefusedByALaboratoryWithoutNumbersForIt) {
  Laboratory older = laboratory();
  older.perceiver.free_modulus.reset();
  EXPECT_NO_THROW(require_abilities(older, estimation("water_is_100")));
  try {
    require_abilities(older, estimation("free"));
    FAIL() << "expected an error";
  } catch (const core::Error& error) {
    EXPECT_STREQ(error.what(),
                 "laboratory thesis: expected /perceiver/free_modulus for numbers of one's own "
                 "in the block how_thick, found none; add it, with its basis");
  }
}

}  // namespace simulated_modulus_test
}  // namespace jnd::experiments
