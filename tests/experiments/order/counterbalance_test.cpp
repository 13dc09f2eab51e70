#include "experiments/order/counterbalance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>

#include "core/error.h"

namespace jnd::experiments {
namespace counterbalance_test {

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

/// Returns a counterbalance with the arms a, b, c and so on, each with one stage: o_a, o_b, o_c
/// and so on.
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
constexpr auto kLatin = Counterbalance::Method::kLatin;
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

TEST(Counterbalance, GivesOneOrderForEachArmOfALatinSquare) {
  EXPECT_EQ(texts_of(cells_of(study_of({counterbalance("o", kLatin, 3)}))),
            (std::vector<std::string>{"o=a,b,c", "o=b,c,a", "o=c,a,b"}));
}

/// Returns a block whose three stimuli come in the rows of a Latin square.
Stage square_block(const std::string& name) {
  Stage stage;
  stage.name = name;
  stage.content =
      Block{.intensities = {1.0, 2.0, 3.0}, .order = {.method = StimulusOrder::Method::kLatin}};
  return stage;
}

TEST(Counterbalance, CrossesTheRowsOfSquaresInBlocksAndArms) {
  Stage arms = counterbalance("o", kOrder, 2);
  std::get<Counterbalance>(arms.content).arms[1].stages.push_back(square_block("inside"));
  const Study study = study_of({square_block("before"), arms});
  const std::vector<std::string> cells = texts_of(cells_of(study));
  EXPECT_EQ(cells.size(), 3u * 2u * 3u);
  EXPECT_EQ(cells.front(), "before=row_1;o=a,b;inside=row_1");
  EXPECT_EQ(cells.back(), "before=row_3;o=b,a;inside=row_3");
  for (const std::string& text : cells) {
    EXPECT_EQ(to_string(cell_from_text(study, text)), text);
  }
  const auto stages =
      stages_of(study, cell_from_text(study, "before=row_2;o=b,a;inside=row_3"));
  EXPECT_EQ(paths_of(stages),
            (std::vector<std::string>{"before", "o/b/o_b", "o/b/inside", "o/a/o_a"}));
  EXPECT_EQ(stages[0].order_row, 1u);
  EXPECT_EQ(stages[2].order_row, 2u);
  EXPECT_EQ(block_of(*stages[2].stage, 2).order.row, 2u);
}

TEST(Counterbalance, GivesEveryRowOfASquareEquallyOften) {
  const Study study = study_of({square_block("s"), counterbalance("o", kOrder, 2)});
  for (const std::uint64_t seed : {1, 2, 3}) {
    std::map<std::size_t, int> rows;
    std::map<std::string, int> orders;
    for (const Cell& cell : planned_cells(study, {}, seed, 0, 12)) {
      ++rows[order_row(cell, "s")];
      ++orders[cell[1].arms[0]];
    }
    EXPECT_EQ(rows, (std::map<std::size_t, int>{{0, 4}, {1, 4}, {2, 4}}));
    EXPECT_EQ(orders, (std::map<std::string, int>{{"a", 6}, {"b", 6}}));
  }
}

/// Returns a study with two orders, which are balanced among women and among men.
Study stratified_study() {
  Stage orders = counterbalance("o", kOrder, 2);
  std::get<Counterbalance>(orders.content).stratify_by = "sex";
  Study study = study_of({orders});
  study.participant_fields = {
      {.name = "sex", .question = {}, .options = {{"female", {}}, {"male", {}}}}};
  return study;
}

TEST(Counterbalance, IsBalancedWithinWhatParticipantsBring) {
  const Study study = stratified_study();
  for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
    std::vector<std::string> completed;
    std::map<std::string, int> filled;
    for (int i = 0; i < 40; ++i) {
      const FieldValues fields = {{"sex", i % 3 == 0 ? "female" : "male"}};
      const Cell cell = least_filled_cell(study, completed, seed, i, fields);
      EXPECT_EQ(field_values(study, cell), fields);
      completed.push_back(to_string(cell));
      ++filled[completed.back()];
      EXPECT_LE(std::abs(filled["sex=female;o=a,b"] - filled["sex=female;o=b,a"]), 1);
      EXPECT_LE(std::abs(filled["sex=male;o=a,b"] - filled["sex=male;o=b,a"]), 1);
      const int first = filled["sex=female;o=a,b"] + filled["sex=male;o=a,b"];
      EXPECT_LE(std::abs(2 * first - (i + 1)), 1) << "even over everybody, too";
    }
  }
}

TEST(Counterbalance, MakesUpForDropOutsOfTheSameStratumAlone) {
  const Study study = stratified_study();
  const std::vector<std::string> completed = {"sex=male;o=a,b", "sex=male;o=a,b",
                                              "sex=male;o=a,b", "sex=female;o=b,a"};
  EXPECT_EQ(to_string(least_filled_cell(study, completed, 1, 4, {{"sex", "female"}})),
            "sex=female;o=a,b");
  EXPECT_EQ(to_string(least_filled_cell(study, completed, 1, 4, {{"sex", "male"}})),
            "sex=male;o=b,a");
}

TEST(Counterbalance, DrawsWhatSimulatedParticipantsBringFromSeedAndParticipant) {
  const Study study = stratified_study();
  std::map<std::string, int> drawn;
  for (int i = 0; i < 1000; ++i) ++drawn[drawn_fields(study, 3, i).at("sex")];
  EXPECT_GT(drawn["female"], 400);
  EXPECT_GT(drawn["male"], 400);
  const std::vector<Cell> cells = planned_cells(study, {}, 3, 10, 4);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(field_values(study, cells[i]),
              drawn_fields(study, 3, 10 + static_cast<std::int64_t>(i)));
  }
  for (const Cell& cell : planned_cells(study, {}, 3, 10, 4, {{"sex", "male"}})) {
    EXPECT_EQ(cell[0].arms[0], "male");
  }
}

TEST(Counterbalance, RefusesParticipantsOfWhomSomethingIsNotKnown) {
  const Study study = stratified_study();
  EXPECT_THROW((void)least_filled_cell(study, {}, 1, 0), core::Error);
  EXPECT_EQ(field_problem(study, {{"sex", "female"}}), "");
  EXPECT_NE(field_problem(study, {{"sexx", "female"}}).find("`sexx`; did you mean `sex`?"),
            std::string::npos)
      << field_problem(study, {{"sexx", "female"}});
  EXPECT_EQ(field_problem(study, {}),
            "expected `sex=VALUE`, VALUE being `female` or `male`, found nothing");
  EXPECT_EQ(field_problem(study, {{"sex", "woman"}}),
            "expected `sex=VALUE`, VALUE being `female` or `male`, found `woman`");
  EXPECT_EQ(field_problem(study, {{"sex", "male"}, {"age", "30"}}),
            "expected a field of the study `study`, found `age`");
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
  // Five of the six who began with b dropped out, so that the next five begin with b.
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

TEST(Counterbalance, RefusesTextThatIsNoCell) {
  const Study study = study_of({square_block("s"), counterbalance("o", kOrder, 2)});
  for (const char* text : {"", "s=row_1", "s=row_4;o=a,b", "s=row_1;o=a,b;", "s=row_1;o=a",
                           "o=a,b;s=row_1", "s=row_1;;o=a,b", "s;o=a,b", "s=row_01;o=a,b"}) {
    EXPECT_THROW(static_cast<void>(cell_from_text(study, text)), core::Error) << text;
  }
}

TEST(Counterbalance, RefusesACellOfAnotherStudy) {
  const Study study = study_of({counterbalance("o", kOrder, 2)});
  EXPECT_THROW(static_cast<void>(stages_of(study, {})), core::Error);
  EXPECT_THROW(static_cast<void>(stages_of(study, {{"o", {"a"}}})), core::Error);
}

}  // namespace counterbalance_test
}  // namespace jnd::experiments
