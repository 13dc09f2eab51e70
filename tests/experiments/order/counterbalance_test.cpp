#include "experiments/order/counterbalance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"

namespace jnd::experiments {
namespace {

Stage stage_of(const std::string& name, Counterbalance content) {
  Stage stage;
  stage.name = name;
  stage.content = std::move(content);
  return stage;
}

Stage rest(const std::string& name) {
  Stage stage;
  stage.name = name;
  stage.content = Break{};
  return stage;
}

/// Arms a, b, c ..., each with one stage, o_a, o_b, o_c ...
Stage counterbalance(const std::string& name, Counterbalance::Method method, int num_arms) {
  Counterbalance content;
  content.method = method;
  for (int i = 0; i < num_arms; ++i) {
    const std::string arm(1, static_cast<char>('a' + i));
    content.arms.push_back({arm, {rest(name + "_" + arm)}});
  }
  return stage_of(name, std::move(content));
}

Study study_of(std::vector<Stage> stages) {
  Study study;
  study.name = "study";
  study.stages = std::move(stages);
  return study;
}

constexpr auto kOrder = Counterbalance::Method::kOrder;
constexpr auto kOneOf = Counterbalance::Method::kOneOf;

std::vector<std::string> texts_of(const std::vector<Cell>& cells) {
  std::vector<std::string> texts;
  for (const Cell& cell : cells) texts.push_back(to_string(cell));
  return texts;
}

std::vector<std::string> paths_of(const std::vector<StageInstance>& stages) {
  std::vector<std::string> paths;
  for (const StageInstance& instance : stages) paths.push_back(instance.path);
  return paths;
}

TEST(Counterbalance, GivesEveryOrderOfTwoOrThreeArms) {
  EXPECT_EQ(texts_of(cells_of(study_of({counterbalance("o", kOrder, 2)}))),
            (std::vector<std::string>{"o=a,b", "o=b,a"}));
  EXPECT_EQ(texts_of(cells_of(study_of({counterbalance("o", kOrder, 3)}))),
            (std::vector<std::string>{"o=a,b,c", "o=a,c,b", "o=b,a,c", "o=b,c,a", "o=c,a,b",
                                      "o=c,b,a"}));
}

TEST(Counterbalance, BalancesPlaceAndPredecessorOfMoreArmsByAWilliamsSquare) {
  for (const int num_arms : {4, 5, 6, 7, 12}) {
    const auto cells = cells_of(study_of({counterbalance("o", kOrder, num_arms)}));
    EXPECT_EQ(cells.size(),
              static_cast<std::size_t>(num_arms % 2 == 0 ? num_arms : 2 * num_arms));
    std::map<std::pair<std::size_t, std::string>, int> at_place;
    std::map<std::pair<std::string, std::string>, int> follows;
    for (const Cell& cell : cells) {
      const auto& arms = cell.at(0).arms;
      ASSERT_EQ(std::set(arms.begin(), arms.end()).size(), static_cast<std::size_t>(num_arms));
      for (std::size_t i = 0; i < arms.size(); ++i) {
        ++at_place[{i, arms[i]}];
        if (i > 0) ++follows[{arms[i - 1], arms[i]}];
      }
    }
    const int times = num_arms % 2 == 0 ? 1 : 2;
    EXPECT_EQ(at_place.size(), static_cast<std::size_t>(num_arms * num_arms));
    EXPECT_EQ(follows.size(), static_cast<std::size_t>(num_arms * (num_arms - 1)));
    for (const auto& [key, count] : at_place) EXPECT_EQ(count, times);
    for (const auto& [key, count] : follows) EXPECT_EQ(count, times);
  }
}

TEST(Counterbalance, CrossesSeveral) {
  EXPECT_EQ(texts_of(cells_of(study_of(
                {counterbalance("p", kOneOf, 2), rest("r"), counterbalance("o", kOrder, 2)}))),
            (std::vector<std::string>{"p=a;o=a,b", "p=a;o=b,a", "p=b;o=a,b", "p=b;o=b,a"}));
}

TEST(Counterbalance, GivesAStudyWithoutArmsOneCell) {
  const Study study = study_of({rest("r")});
  EXPECT_EQ(texts_of(cells_of(study)), std::vector<std::string>{""});
  EXPECT_EQ(least_filled_cell(study, {"", ""}, 1, 2), Cell{});
  EXPECT_EQ(paths_of(stages_of(study, {})), std::vector<std::string>{"r"});
}

TEST(Counterbalance, ReadsACellBackFromItsText) {
  const Study study =
      study_of({counterbalance("p", kOneOf, 3), counterbalance("o", kOrder, 3)});
  for (const Cell& cell : cells_of(study)) {
    EXPECT_EQ(cell_from_text(study, to_string(cell)), cell);
  }
  EXPECT_THROW(static_cast<void>(cell_from_text(study, "p=z;o=a,b,c")), core::Error);
  EXPECT_THROW(static_cast<void>(cell_from_text(study, "")), core::Error);
}

TEST(Counterbalance, StartsSevenOfThirteenWithOneArmAndSixWithTheOther) {
  const Study study = study_of({counterbalance("o", kOrder, 2)});
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    std::map<std::string, int> starts;
    for (const Cell& cell : planned_cells(study, {}, seed, 0, 13)) ++starts[cell[0].arms[0]];
    EXPECT_EQ(std::abs(starts["a"] - starts["b"]), 1) << seed;
  }
}

TEST(Counterbalance, KeepsEachOfTwoCrossedFactorsEvenAfterEverySession) {
  const Study study =
      study_of({counterbalance("p", kOneOf, 2), counterbalance("o", kOrder, 2)});
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    std::map<std::string, int> of_cell, of_priming, of_start;
    for (const Cell& cell : planned_cells(study, {}, seed, 0, 13)) {
      ++of_cell[to_string(cell)];
      ++of_priming[cell[0].arms[0]];
      ++of_start[cell[1].arms[0]];
      EXPECT_LE(std::abs(of_priming["a"] - of_priming["b"]), 1) << seed;
      EXPECT_LE(std::abs(of_start["a"] - of_start["b"]), 1) << seed;
    }
    for (const auto& [cell, count] : of_cell) EXPECT_GE(count, 3) << cell;
  }
}

TEST(Counterbalance, MakesUpForDropOuts) {
  // Five of six who began with b dropped out: the next five begin with b.
  const Study study = study_of({counterbalance("o", kOrder, 2)});
  std::vector<std::string> completed(6, "o=a,b");
  completed.push_back("o=b,a");
  for (std::int64_t participant = 12; participant < 17; ++participant) {
    const Cell cell = least_filled_cell(study, completed, 7, participant);
    EXPECT_EQ(to_string(cell), "o=b,a");
    completed.push_back(to_string(cell));
  }
}

TEST(Counterbalance, LeavesSessionsOfAnotherVersionOfTheStudyOut) {
  const Study study = study_of({counterbalance("o", kOrder, 2)});
  const std::vector<std::string> completed = {"old=x", "old=y", "", "o=a,b"};
  EXPECT_EQ(to_string(least_filled_cell(study, completed, 7, 4)), "o=b,a");
}

TEST(Counterbalance, DrawsTiesFromSeedAndParticipantAlone) {
  const Study study = study_of({counterbalance("o", kOrder, 3)});
  EXPECT_EQ(least_filled_cell(study, {}, 5, 3), least_filled_cell(study, {}, 5, 3));
  std::set<std::string> seen;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    seen.insert(to_string(least_filled_cell(study, {}, seed, 0)));
  }
  EXPECT_EQ(seen.size(), 6u);
}

TEST(Counterbalance, LaysTheStagesOutInTheOrderOfTheCell) {
  Stage order = counterbalance("o", kOrder, 3);
  std::get<Counterbalance>(order.content).between = {rest("pause")};
  const Study study = study_of({rest("before"), order, rest("after")});
  EXPECT_EQ(paths_of(stages_of(study, cell_from_text(study, "o=c,a,b"))),
            (std::vector<std::string>{"before", "o/c/o_c", "o/between_1/pause", "o/a/o_a",
                                      "o/between_2/pause", "o/b/o_b", "after"}));
}

TEST(Counterbalance, RunsOneArmOfOneOfAndStagesForThatArmOnly) {
  Stage for_b = rest("for_b");
  for_b.only_for = {{"p", "b"}};
  const Study study = study_of({for_b, counterbalance("p", kOneOf, 2)});
  EXPECT_EQ(paths_of(stages_of(study, cell_from_text(study, "p=a"))),
            std::vector<std::string>{"p/a/p_a"});
  EXPECT_EQ(paths_of(stages_of(study, cell_from_text(study, "p=b"))),
            (std::vector<std::string>{"for_b", "p/b/p_b"}));
}

TEST(Counterbalance, RefusesACellOfAnotherStudy) {
  const Study study = study_of({counterbalance("o", kOrder, 2)});
  EXPECT_THROW(static_cast<void>(stages_of(study, {})), core::Error);
  EXPECT_THROW(static_cast<void>(stages_of(study, {{"o", {"a"}}})), core::Error);
}

}  // namespace
}  // namespace jnd::experiments
