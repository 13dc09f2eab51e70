#include <gtest/gtest.h>

#include <cmath>

#include "core/media/viscous_drag.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/median_person.h"
#include "experiments/participants/thesis_laboratory.h"

namespace jnd::experiments {
namespace simulated_matching_test {

Study matching_study(const std::string& standard_medium, std::vector<double> standards) {
  Study study;
  study.name = "matching";
  study.stages.push_back({.name = "match",
                          .content = Block{.procedure = "matching",
                                           .medium = "viscous",
                                           .quantity = "viscosity_pa_s",
                                           .intensities = {1.0, 20.0},
                                           .standard_medium = standard_medium,
                                           .standards = std::move(standards),
                                           .repetitions = 4,
                                           .coarse_step = 0.5,
                                           .fine_step = 0.2,
                                           .max_intensity = 40.0}});
  return study;
}

std::vector<AnsweredTrial> answers(const Study& study, const Laboratory& there,
                                   std::uint64_t seed) {
  const AnswerSimulator simulator(study, there);
  return simulator.answers(stages_of(study, cells_of(study).front()), seed).front().trials;
}

TEST(SimulatedMatching, AQuietPersonMatchesWhatFeelsAlike) {
  // The drag of a sphere is 1.2322 viscosity speed, and that of the hand 1.7760 viscosity
  // speed. So 8 Pa s of the one feel like 5.550 Pa s of the other.
  const Laboratory quiet = without_noise(thesis_laboratory());
  for (const AnsweredTrial& trial :
       answers(matching_study("viscous_stokes", {8.0}), quiet, 1)) {
    EXPECT_NEAR(*trial.response, 8.0 * 1.2322 / 1.7760, 0.4)
        << "from " << *trial.planned.starting_intensity;
  }
}

TEST(SimulatedMatching, WithinAMediumAQuietPersonFindsTheStandard) {
  const Laboratory quiet = without_noise(thesis_laboratory());
  for (const AnsweredTrial& trial : answers(matching_study("viscous", {4.0, 12.0}), quiet, 1)) {
    EXPECT_NEAR(std::log(*trial.response / *trial.planned.reference_intensity), 0.0, 0.1);
  }
}

TEST(SimulatedMatching, TheConstantErrorIsThePersonsCriterion) {
  Laboratory there = thesis_laboratory();
  there.perceiver.criterion_sd_ln = 0.2;
  const double per_viscosity = core::ViscousDrag({.viscosity_pa_s = 0.0}).shape_constant_m();
  const double mechanical = there.device.mechanical_viscosity_n_s_per_m;
  const auto felt = [&](double viscosity) { return per_viscosity * viscosity + mechanical; };
  const Study study = matching_study("viscous", {6.0, 12.0});
  double sum_of_errors = 0.0, squares = 0.0, common = 0.0;
  int num_trials = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const double criterion = draw_person(there, seed).criterion_ln;
    double own = 0.0;
    const auto trials = answers(study, there, seed);
    for (const AnsweredTrial& trial : trials) {
      const double match_ln =
          std::log(felt(*trial.response) / felt(*trial.planned.reference_intensity));
      own += match_ln / static_cast<double>(trials.size());
      sum_of_errors += match_ln - criterion;
      ++num_trials;
    }
    common += own * criterion;
    squares += criterion * criterion;
  }
  // A single look at the standard has an error of ln(1.152) / sqrt 2 = 0.1, and there are 640
  // trials.
  EXPECT_NEAR(sum_of_errors / num_trials, 0.0, 0.02);
  EXPECT_NEAR(common / squares, 1.0, 0.1);
}

TEST(SimulatedMatching, APersonWhoIsLessSureScattersMore) {
  Laboratory sure = without_noise(thesis_laboratory()), unsure = sure;
  sure.perceiver.weber_fraction = 0.05;
  unsure.perceiver.weber_fraction = 0.3;
  const auto spread = [](const Laboratory& there) {
    double squares = 0.0;
    int num = 0;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      for (const AnsweredTrial& trial :
           answers(matching_study("viscous", {8.0}), there, seed)) {
        squares += std::pow(std::log(*trial.response / 8.0), 2);
        ++num;
      }
    }
    return std::sqrt(squares / num);
  };
  EXPECT_GT(spread(unsure), 2.0 * spread(sure));
}

TEST(SimulatedMatching, GoingBackToTheStandardMakesMatchesBetter) {
  Laboratory once = without_noise(thesis_laboratory());
  once.perceiver.weber_fraction = 0.2;
  Laboratory often = once;
  often.perceiver.look_again_probability = 0.8;
  const auto squares = [](const Laboratory& there) {
    double sum = 0.0;
    for (std::uint64_t seed = 1; seed <= 30; ++seed) {
      for (const AnsweredTrial& trial :
           answers(matching_study("viscous", {8.0}), there, seed)) {
        sum += std::pow(std::log(*trial.response / 8.0), 2);
      }
    }
    return sum;
  };
  EXPECT_LT(squares(often), 0.7 * squares(once));
}

}  // namespace simulated_matching_test
}  // namespace jnd::experiments
