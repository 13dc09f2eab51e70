#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "experiments/adaptive/level_scale.h"
#include "experiments/adaptive/quest_plus.h"
#include "support/reference_data.h"

namespace jnd::experiments {
namespace quest_plus_reference_test {

using nlohmann::json;

constexpr double kTolerance = 1e-10;

/// The reference was computed by NumPy and SciPy with the script beside it.
const json& reference() { return test_support::reference_data("quest_plus/quest_plus.json"); }

ParameterGrid grid_of(const json& parameter) {
  ParameterGrid grid{parameter.at("values"), std::nullopt};
  if (parameter.contains("prior")) {
    const json& prior = parameter.at("prior");
    grid.prior = {.median = prior.at("median"), .sd_ln = prior.at("sd_ln")};
  }
  return grid;
}

QuestPlusModel model_of(const json& c) {
  const json& parameters = c.at("parameters");
  const auto grid = [&](const char* name) { return grid_of(parameters.at(name)); };
  if (c.at("name") == "weber") {
    return weber_model({grid("pse"), grid("weber_fraction"), grid("lapse_rate")});
  }
  const ThresholdGrids grids = {grid("threshold"), grid("slope"), grid("guess_rate"),
                                grid("lapse_rate")};
  return c.at("name") == "gauss" ? gauss_model(grids) : weibull_model(grids);
}

void expect_trial(const QuestPlus& quest, const QuestPlusPosterior& posterior,
                  const json& trial) {
  EXPECT_NEAR(quest.entropy_bits(posterior), trial.at("entropy_bits"), kTolerance);
  const Eigen::VectorXd information = quest.expected_information_bits(posterior);
  const json& expected = trial.at("expected_entropy_bits");
  for (Eigen::Index i = 0; i < information.size(); ++i) {
    EXPECT_NEAR(quest.entropy_bits(posterior) - information[i],
                expected.at(static_cast<std::size_t>(i)), kTolerance);
  }
  const auto estimates = quest.estimates(posterior);
  EXPECT_EQ(estimates.size(), trial.at("marginals").size());
  for (const QuestPlusEstimate& estimate : estimates) {
    const json& marginal = trial.at("marginals").at(estimate.name);
    EXPECT_NEAR(estimate.mean, marginal.at("mean"), kTolerance) << estimate.name;
    EXPECT_NEAR(estimate.sd, marginal.at("sd"), kTolerance) << estimate.name;
    EXPECT_LE(estimate.low, estimate.mean);
    EXPECT_GE(estimate.high, estimate.mean);
  }
}

TEST(QuestPlusReference, AgreesWithNumPyOverThirtyTrialsOfEachModel) {
  EXPECT_EQ(reference().at("cases").size(), 3u);
  for (const json& c : reference().at("cases")) {
    SCOPED_TRACE(c.at("name").get<std::string>());
    const QuestPlus quest(
        {.model = model_of(c), .intensities = c.at("intensities"), .max_trials = 30});
    core::RandomStream not_drawn_from(1, "quest_plus_reference_test");
    QuestPlusPosterior posterior = quest.prior();
    std::vector<LevelAnswer> answers;
    EXPECT_EQ(c.at("trials").size(), 30u);
    for (const json& trial : c.at("trials")) {
      SCOPED_TRACE("trial " + std::to_string(answers.size()));
      expect_trial(quest, posterior, trial);
      EXPECT_EQ(quest.next_intensity(posterior, not_drawn_from), trial.at("intensity"));
      answers.push_back({trial.at("intensity"), trial.at("yes")});
      quest.bring_up_to_date(posterior, answers);
    }
  }
}

const json& grid_ends() { return test_support::reference_data("quest_plus/grid_ends.json"); }

QuestPlusPosterior posterior_of(const QuestPlus& quest, const json& answers) {
  std::vector<LevelAnswer> all;
  for (const json& one : answers) {
    for (int i = 0; i < one.at(2).get<int>(); ++i) {
      all.push_back({one.at(0).get<double>(), i < one.at(1).get<int>()});
    }
  }
  return quest.posterior(all);
}

TEST(QuestPlusReference, ReachesTheEndsOfItsGridsAsSciPyHasIt) {
  int num_reached = 0;
  for (const json& c : grid_ends().at("cases")) {
    SCOPED_TRACE(c.at("name").get<std::string>());
    const auto grid = [&](const char* name) -> ParameterGrid {
      return {equally_spaced(LevelScale::kLogarithmic, c.at(name).at(0), c.at(name).at(1),
                             c.at("grid_values")),
              std::nullopt};
    };
    const QuestPlus quest(
        {.model = weber_model({grid("pse"),
                               grid("weber_fraction"),
                               {{grid_ends().at("lapse_rate").get<double>()}, std::nullopt}}),
         .intensities = {10.0},
         .max_trials = 100});
    bool any_reached = false;
    for (const QuestPlusEstimate& one : quest.estimates(posterior_of(quest, c.at("answers")))) {
      if (one.name == "lapse_rate") {
        EXPECT_FALSE(one.reaches_an_end()) << "a parameter that is known";
        continue;
      }
      const json& expected = c.at("reached").at(one.name);
      EXPECT_EQ(one.reached_low.has_value(), expected.at(0).get<bool>()) << one.name;
      EXPECT_EQ(one.reached_high.has_value(), expected.at(1).get<bool>()) << one.name;
      if (one.reached_low) {
        EXPECT_EQ(*one.reached_low, c.at(one.name).at(0));
      }
      if (one.reached_high) {
        EXPECT_EQ(*one.reached_high, c.at(one.name).at(1));
      }
      any_reached = any_reached || one.reaches_an_end();
      num_reached += one.reaches_an_end() ? 1 : 0;
    }
    if (any_reached) continue;
    for (const char* name : {"pse", "weber_fraction"}) {
      EXPECT_LT(c.at("beyond").at(name).at(0).get<double>(), 0.025) << name;
      EXPECT_LT(c.at("beyond").at(name).at(1).get<double>(), 0.025) << name;
    }
  }
  EXPECT_EQ(num_reached, 8);
}

}  // namespace quest_plus_reference_test
}  // namespace jnd::experiments
