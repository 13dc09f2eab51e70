#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "experiments/participants/abilities.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/median_person.h"
#include "experiments/participants/thesis_laboratory.h"

namespace jnd::experiments {
namespace simulated_stiffness_test {

Study study_of(Block block) {
  block.medium = "solid";
  block.quantity = "stiffness_n_per_m";
  Study study;
  study.name = "stiffness";
  study.stages.push_back({.name = "stiff", .content = std::move(block)});
  return study;
}

std::vector<AnsweredTrial> answers(const Study& study, const Laboratory& there,
                                   std::uint64_t seed = 1) {
  const AnswerSimulator simulator(study, there);
  return simulator.answers(stages_of(study, cells_of(study).front()), seed).front().trials;
}

TEST(SimulatedStiffness, IsToldApartByItsOwnWeberFraction) {
  // There is only reading noise, so 84.13 % say stiffer at reference (1 + w).
  Laboratory plain = without_noise(thesis_laboratory());
  plain.pressing->weber_fraction = 0.23;
  const Study study = study_of({.procedure = "constant_stimuli",
                                .intensities = {400.0 * 1.23},
                                .reference_intensity = 400.0,
                                .repetitions = 20000});
  double yes = 0.0;
  for (const AnsweredTrial& trial : answers(study, plain)) yes += *trial.response;
  EXPECT_NEAR(yes / 20000.0, 0.8413, 4.0 * std::sqrt(0.8413 * 0.1587 / 20000.0));
  EXPECT_NEAR(median_weber_fraction(plain, std::get<Block>(study.stages.front().content)), 0.23,
              1e-12);
}

TEST(SimulatedStiffness, TheDevicesViscosityPlaysNoRole) {
  Laboratory heavy = thesis_laboratory(), light = heavy;
  heavy.device.mechanical_viscosity_n_s_per_m = 50.0;
  light.device.mechanical_viscosity_n_s_per_m = 0.0;
  const Study study = study_of({.procedure = "constant_stimuli",
                                .intensities = {300.0, 350.0, 450.0, 500.0},
                                .reference_intensity = 400.0,
                                .repetitions = 50});
  const auto a = answers(study, heavy), b = answers(study, light);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].response, b[i].response);
}

TEST(SimulatedStiffness, AQuietPersonMatchesTheStandard) {
  const Study study = study_of({.procedure = "matching",
                                .intensities = {200.0, 900.0},
                                .standard_medium = "solid",
                                .standards = {400.0},
                                .repetitions = 2,
                                .coarse_step = 100.0,
                                .fine_step = 10.0});
  for (const AnsweredTrial& trial : answers(study, without_noise(thesis_laboratory()))) {
    EXPECT_NEAR(*trial.response, 400.0, 20.0);
  }
}

TEST(SimulatedStiffness, LessThanTheThresholdFeelsLikeNothing) {
  const Laboratory there = without_noise(thesis_laboratory());
  const SimulatedParticipant participant(there, 1);
  Block block;
  block.medium = "solid";
  const Perceiver& perceiver = participant.perceiver(block);
  EXPECT_NEAR(perceiver.reading_ln(0.0, {.trial = 1}), perceiver.free_space_ln(), 1e-6);
  EXPECT_GT(perceiver.reading_ln(100.0, {.trial = 1}), perceiver.free_space_ln() + 1.0);
}

TEST(SimulatedStiffness, APressGoesAsDeepAndAsHighAsTheLaboratorySays) {
  const Laboratory there = thesis_laboratory();
  const StrokeIntent press = SimulatedParticipant(there, 1).presses("constant_stimuli", 0.1);
  EXPECT_NEAR(press.height_m - press.lift_m.value(), 0.1 - there.pressing->depth_m, 1e-12);
  EXPECT_NEAR(press.height_m + press.lift_m.value(), 0.1 + there.pressing->lift_m, 1e-12);
  EXPECT_NEAR(2.0 * std::numbers::pi * press.amplitude_m / press.max_speed_m_per_s,
              there.pressing->period_s, 1e-12);
}

TEST(SimulatedStiffness, IsRefusedByALaboratoryWithoutNumbersForIt) {
  Laboratory older = thesis_laboratory();
  older.pressing.reset();
  const Study study = study_of({.procedure = "constant_stimuli",
                                .intensities = {300.0, 500.0},
                                .reference_intensity = 400.0});
  EXPECT_THROW(require_abilities(older, study), core::Error);
}

}  // namespace simulated_stiffness_test
}  // namespace jnd::experiments
