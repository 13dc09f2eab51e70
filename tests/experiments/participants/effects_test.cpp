#include "experiments/participants/effects.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>

#include "core/error.h"
#include "experiments/designed_study.h"
#include "experiments/order/cell.h"
#include "experiments/order/counterbalance.h"
#include "experiments/participants/answer_simulator.h"
#include "experiments/participants/median_person.h"
#include "experiments/participants/thesis_laboratory.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/study/stage_walk.h"
#include "support/places.h"

namespace jnd::experiments {
namespace effects_test {

Laboratory laboratory_with(const std::vector<std::string>& effects) {
  return parse_laboratory(with_effects(thesis_laboratory().text, effects), "effects");
}

std::string refused(const std::vector<std::string>& effects) {
  try {
    (void)laboratory_with(effects);
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

TEST(Effects, MultiplyAndAddWhereAllTheirLevelsHold) {
  const Laboratory laboratory = laboratory_with(
      {"fluid=thin:weber_fraction_factor=2,pse_factor=1.5",
       "fluid=thin,priming=primed:weber_fraction_factor=3,exponent_difference=-0.1",
       "block=thin_a:magnitude_factor=1.2"});
  ASSERT_EQ(laboratory.effects.size(), 3U);
  const Laboratory::Effect nothing = effects_on(laboratory, {{"fluid", "thick"}});
  EXPECT_EQ(nothing.weber_fraction_factor, 1.0);
  const Laboratory::Effect thin = effects_on(laboratory, {{"fluid", "thin"}});
  EXPECT_EQ(thin.weber_fraction_factor, 2.0);
  EXPECT_EQ(thin.exponent_difference, 0.0);
  const Laboratory::Effect both =
      effects_on(laboratory, {{"block", "thin_a"}, {"fluid", "thin"}, {"priming", "primed"}});
  EXPECT_EQ(both.weber_fraction_factor, 6.0);
  EXPECT_EQ(both.pse_factor, 1.5);
  EXPECT_EQ(both.exponent_difference, -0.1);
  EXPECT_EQ(both.magnitude_factor, 1.2);
}

TEST(Effects, ChangeAPersonByTheSameInEveryBlock) {
  const Laboratory laboratory =
      laboratory_with({"fluid=thin:weber_fraction_factor=2,weber_fraction_sd_ln=0.3,"
                       "pse_factor=1.5,exponent_difference=0.2,magnitude_factor=3"});
  double sum = 0.0, squares = 0.0;
  constexpr int kPeople = 4000;
  for (std::uint64_t seed = 1; seed <= kPeople; ++seed) {
    const Person person = draw_person(laboratory, seed);
    const Person thin =
        affected(laboratory, person, seed, {{"fluid", "thin"}, {"block", "thin_a"}});
    const Person again =
        affected(laboratory, person, seed, {{"fluid", "thin"}, {"block", "thin_c"}});
    EXPECT_EQ(thin.weber_fraction, again.weber_fraction);
    EXPECT_NEAR(thin.criterion_ln - person.criterion_ln, std::log(1.5), 1e-12);
    EXPECT_NEAR(thin.exponent - person.exponent, 0.2, 1e-12);
    EXPECT_NEAR(thin.unit / person.unit, 3.0, 1e-12);
    EXPECT_EQ(affected(laboratory, person, seed, {{"fluid", "thick"}}).weber_fraction,
              person.weber_fraction);
    const double change = std::log(thin.weber_fraction / person.weber_fraction);
    sum += change;
    squares += change * change;
  }
  const double mean = sum / kPeople;
  EXPECT_NEAR(mean, std::log(2.0), 4.0 * 0.3 / std::sqrt(kPeople));
  EXPECT_NEAR(std::sqrt(squares / kPeople - mean * mean), 0.3, 0.02);
}

TEST(Effects, AreInWhatTheMedianPersonShouldComeTo) {
  const Study study = read_study_text(designed_study(fluid_contrast()), "x.json");
  const Laboratory plain = thesis_laboratory();
  const Laboratory changed = laboratory_with({"fluid=thin:weber_fraction_factor=2"});
  for_each_stage(study.stages, [&](const Stage& stage) {
    if (!std::holds_alternative<Block>(stage.content)) return;
    const Block block = block_of(stage, 0);
    // The fraction w0 (1 + b / (c reference)) grows by the same factor as w0.
    const double factor = block.levels.at("fluid") == "thin" ? 2.0 : 1.0;
    EXPECT_NEAR(median_weber_fraction(changed, block),
                factor * median_weber_fraction(plain, block), 1e-6)
        << stage.name;
  });
}

TEST(Effects, OfABiasAreInTheAnswersOfThoseWhoHaveIt) {
  const Study study = read_study_text(designed_study(fluid_contrast()), "x.json");
  const Laboratory laboratory = laboratory_with({"priming=primed:pse_factor=3"});
  const AnswerSimulator simulator(study, laboratory);
  std::map<std::string, std::pair<int, int>> thicker;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    for (const Cell& cell : cells_of(study)) {
      for (const AnsweredBlock& block : simulator.answers(stages_of(study, cell), seed)) {
        auto& [said, asked] = thicker[people_levels(cell).at("priming")];
        for (const AnsweredTrial& trial : block.trials) {
          said += trial.response > 0.5 ? 1 : 0;
          ++asked;
        }
      }
    }
  }
  const auto share = [&](const std::string& arm) {
    return static_cast<double>(thicker.at(arm).first) / thicker.at(arm).second;
  };
  EXPECT_LT(share("primed"), share("control") - 0.1);
}

TEST(Effects, ThatAreWrittenWronglyAreToldInOneSentence) {
  EXPECT_NE(refused({"fluid=thin"}).find("which has no colon"), std::string::npos);
  EXPECT_NE(refused({"fluid:weber_fraction_factor=2"}).find("`fluid` is no NAME=VALUE"),
            std::string::npos);
  EXPECT_NE(refused({"fluid=thin:weber_fraction_factor=two"}).find("`two` is no number"),
            std::string::npos);
  EXPECT_NE(refused({"fluid=thin:pse_facto=2"})
                .find("of which `pse_facto` is no amount; did you mean `pse_factor`?"),
            std::string::npos);
  EXPECT_NE(refused({"fluid=thin:weber_fraction_factor=0"})
                .find("/effects/0/weber_fraction_factor: expected a number from 0.001 to 1000"),
            std::string::npos);
}

TEST(Effects, OfLevelsThatTheStudyHasNotAreRefused) {
  const Study study = read_study_text(designed_study(fluid_contrast()), "x.json");
  const auto problem = [&](const std::string& effect) -> std::string {
    try {
      require_known_effects(laboratory_with({effect}), study);
    } catch (const core::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(problem("fluid=thin:pse_factor=2"), "");
  EXPECT_EQ(problem("block=thin_c,priming=control:pse_factor=2"), "");
  EXPECT_NE(problem("fluid=thinn:pse_factor=2").find("found `thinn`; did you mean `thin`?"),
            std::string::npos);
  EXPECT_NE(problem("fluit=thin:pse_factor=2").find("found `fluit`; did you mean `fluid`?"),
            std::string::npos);
}

TEST(Effects, OnARatingMoveItByStepsAndDifferBetweenPeople) {
  const Laboratory laboratory =
      laboratory_with({"fluid=thin:rating_difference=1.5,rating_sd=0.4"});
  EXPECT_EQ(effects_on(laboratory, {{"fluid", "thin"}}).rating_difference, 1.5);
  double sum = 0.0, squares = 0.0;
  constexpr int kPeople = 4000;
  for (std::uint64_t seed = 1; seed <= kPeople; ++seed) {
    const Person person = draw_person(laboratory, seed);
    EXPECT_EQ(person.rating_steps, 0.0);
    const double steps = affected(laboratory, person, seed, {{"fluid", "thin"}}).rating_steps;
    sum += steps;
    squares += steps * steps;
  }
  const double mean = sum / kPeople;
  EXPECT_NEAR(mean, 1.5, 4.0 * 0.4 / std::sqrt(kPeople));
  EXPECT_NEAR(std::sqrt(squares / kPeople - mean * mean), 0.4, 0.02);
}

/// Returns a study with every block that is shipped. The names are those of study and block
/// together.
Study all_shipped_blocks() {
  Study all;
  for (const auto& entry :
       std::filesystem::directory_iterator(test_support::source_folder() / "protocols")) {
    const std::string file = entry.path().filename().string();
    if (!file.ends_with(".json") || file.ends_with(".schema.json")) continue;
    const Study study = read_study(entry.path());
    for_each_stage(study.stages, [&](const Stage& stage) {
      if (!std::holds_alternative<Block>(stage.content)) return;
      Stage& block = all.stages.emplace_back(stage);
      block.name = study.name + "." + stage.name;
      block.only_for.clear();
      block.interleaving.reset();
    });
  }
  all.name = "all";
  return all;
}

/// Returns the answers of a few people in every block, by the block's name.
std::map<std::string, std::vector<std::optional<double>>> answers_with(
    const Study& study, const Laboratory& laboratory) {
  std::map<std::string, std::vector<std::optional<double>>> answers;
  const AnswerSimulator simulator(study, laboratory);
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    // Each block is simulated alone, because random draws depend on the number of a trial in
    // the session.
    for (const StageInstance& alone : stages_of(study, cells_of(study).front())) {
      for (const AnsweredBlock& block : simulator.answers({alone}, seed)) {
        for (const AnsweredTrial& trial : block.trials) {
          answers[block.stage->name].push_back(trial.response);
        }
      }
    }
  }
  return answers;
}

// Compares the list of amounts with what simulated people do, in every shipped block. An amount
// that is said to act must change answers there, and any other must change none.
TEST(Effects, ActWhereTheyAreSaidToAndNowhereElse) {
  const Study study = all_shipped_blocks();
  const Laboratory plain = thesis_laboratory();
  const auto before = answers_with(study, plain);
  ASSERT_GT(before.size(), 15U);
  const auto holds = [&](const std::string& amount, const Laboratory::Effect& effect) {
    Laboratory changed = plain;
    changed.effects = {effect};  // Without levels, the effect applies to all blocks.
    const auto after = answers_with(study, changed);
    int num_acting = 0;
    for (const Stage& stage : study.stages) {
      const std::vector<std::string> acting =
          amounts_that_act_on(std::get<Block>(stage.content));
      const bool acts = std::ranges::find(acting, amount) != acting.end();
      num_acting += acts ? 1 : 0;
      EXPECT_EQ(after.at(stage.name) != before.at(stage.name), acts)
          << amount << " in " << stage.name;
    }
    EXPECT_GT(num_acting, 0) << amount;
  };
  holds("weber_fraction_factor", {.weber_fraction_factor = 4.0});
  holds("weber_fraction_sd_ln", {.weber_fraction_sd_ln = 1.0});
  holds("pse_factor", {.pse_factor = 3.0});
  holds("pse_sd_ln", {.pse_sd_ln = 1.0});
  holds("exponent_difference", {.exponent_difference = 0.6});
  holds("exponent_sd", {.exponent_sd = 0.5});
  holds("magnitude_factor", {.magnitude_factor = 3.0});
  holds("magnitude_sd_ln", {.magnitude_sd_ln = 1.0});
  holds("rating_difference", {.rating_difference = 2.0});
  holds("rating_sd", {.rating_sd = 2.0});
}

TEST(Effects, ThatChangeNothingAreRefusedWithThoseThatDo) {
  const Study study = read_study_text(designed_study(fluid_contrast()), "x.json");
  const auto problem = [&](const std::string& effect) -> std::string {
    try {
      require_known_effects(laboratory_with({effect}), study);
    } catch (const core::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(
      problem("fluid=thin:magnitude_factor=1.3"),
      "laboratory thesis: effect on `fluid=thin`: expected an amount that changes the "
      "answers in `thin_a` or `thin_c`: `weber_fraction_factor`, `weber_fraction_sd_ln`, "
      "`pse_factor` or `pse_sd_ln`, found `magnitude_factor`, which changes nothing there");
  EXPECT_NE(problem("priming=primed:rating_sd=1").find("found `rating_sd`"), std::string::npos);
  EXPECT_EQ(problem("fluid=thin:magnitude_factor=1"), "") << "nothing is asked for";
  EXPECT_EQ(
      problem("fluid=thin,block=thick_b:pse_factor=2"),
      "laboratory thesis: effect on `block=thick_b,fluid=thin`: expected levels that some "
      "block has together, found none that does; give the effect fewer levels");
  EXPECT_NE(refused({"thin_a:pse_factor=2"}).find("a block is written `block=thin_a`"),
            std::string::npos);
  EXPECT_NE(
      refused({"fluid=thin:rating_diference=2"}).find("did you mean `rating_difference`?"),
      std::string::npos);
}

}  // namespace effects_test
}  // namespace jnd::experiments
