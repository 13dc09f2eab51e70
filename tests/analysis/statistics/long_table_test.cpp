#include "analysis/statistics/long_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"

namespace long_table_test {

using namespace jnd;
using namespace jnd::analysis;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

constexpr char kRows[] =
    "who,fluid,w\n"
    "P1,thin,0.5\nP1,thick,0.2\nP2,thin,0.7\nP2,thick,0.3\nP2,thick,0.5\n"
    "P3,thin,0.4\nP3,thick,NA\nP3,middle,0.3\n";

LongTable read(const LongColumns& columns, const char* text = kRows) {
  return parse_long(text, "t.csv", columns);
}

TEST(LongTable, PairsByPersonAveragesAndNamesWhoLacksACondition) {
  const LongTable table =
      read({.value = "w", .by = "fluid", .pair = "who", .levels = {"thick", "thin"}});
  ASSERT_EQ(table.groups.size(), 1U);
  EXPECT_EQ(table.num_missing, 1);
  const LongGroup& group = table.groups[0];
  EXPECT_THAT(group.conditions, ElementsAre("thick", "thin"));
  EXPECT_THAT(group.complete.people, ElementsAre("P1", "P2"));
  EXPECT_THAT(group.incomplete, ElementsAre("P3"));
  EXPECT_EQ(group.num_averaged, 1);
  const ComparedColumns columns = two_conditions(group, true, "t.csv");
  EXPECT_THAT(columns.a, ElementsAre(0.2, 0.4));
  EXPECT_THAT(columns.b, ElementsAre(0.5, 0.7));
}

TEST(LongTable, GroupsOfDifferentPeopleKeepEveryValue) {
  const LongTable table = read({.value = "w", .by = "fluid", .levels = {"thin", "thick"}});
  const ComparedColumns columns = two_conditions(table.groups[0], false, "t.csv");
  EXPECT_THAT(columns.a, ElementsAre(0.5, 0.7, 0.4));
  EXPECT_THAT(columns.b, ElementsAre(0.2, 0.3, 0.5));
}

TEST(LongTable, SemicolonsAndDecimalCommasAreReadAsWell) {
  const LongTable table =
      read({.value = "w", .by = "fluid"}, "fluid;w\nthin;0,5\nthick;0,25\nthick;\n");
  EXPECT_THAT(table.groups[0].values[0], ElementsAre(0.5));
  EXPECT_THAT(table.groups[0].values[1], ElementsAre(0.25));
  EXPECT_EQ(table.num_missing, 1);
}

TEST(LongTable, GroupsComeInTheOrderOfTheirFirstRows) {
  const LongTable table = read({.value = "w", .by = "fluid", .group_by = {"who"}});
  ASSERT_EQ(table.groups.size(), 3U);
  EXPECT_EQ(table.groups[1].key[0].second, "P2");
  EXPECT_THAT(table.groups[1].values[1], ElementsAre(0.3, 0.5));
}

TEST(LongTable, ConditionsHaveOneOrderInEveryGroupAndMayBeCalledNone) {
  const LongTable table = read({.value = "w", .by = "drug", .group_by = {"sex"}},
                               "sex,drug,w\nf,none,1\nf,low,2\nm,low,3\nm,none,4\nm,NA,5\n");
  ASSERT_EQ(table.groups.size(), 2U);
  EXPECT_THAT(table.groups[0].conditions, ElementsAre("none", "low"));
  EXPECT_THAT(table.groups[1].conditions, ElementsAre("none", "low"));
  EXPECT_THAT(table.groups[1].values[0], ElementsAre(4.0));
  EXPECT_EQ(table.num_missing, 1);
}

std::string problem_of(const LongColumns& columns, const char* text = kRows) {
  try {
    const LongTable table = parse_long(text, "t.csv", columns);
    (void)two_conditions(table.groups.at(0), false, "t.csv");
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

TEST(LongTable, ProblemsAreToldWithTheirPlace) {
  EXPECT_THAT(problem_of({.value = "w", .by = "fluid"}),
              HasSubstr("expected two conditions, found 3 (thin, thick, middle)"));
  EXPECT_THAT(problem_of({.value = "w", .by = "fluid", .levels = {"thin", "water"}}),
              HasSubstr("expected one of thin, thick, middle for --levels, found \"water\""));
  EXPECT_THAT(problem_of({.value = "v", .by = "fluid"}), HasSubstr("v"));
  EXPECT_THAT(problem_of({.value = "w", .by = "fluid"}, "fluid,w\nthin,0.5\nthick,much\n"),
              HasSubstr("t.csv:3: w: expected a number, or NA, found"));
}

}  // namespace long_table_test
