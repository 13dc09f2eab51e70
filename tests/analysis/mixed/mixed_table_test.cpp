#include "analysis/mixed/mixed_table.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace jnd::analysis {
namespace mixed_table_test {

TrialTable trials(const std::vector<std::string>& variables, const std::string& text) {
  return parse_trial_table(text, "t.csv",
                           {.answers = {.yes = "y", .yes_value = {}, .trials = {}},
                            .variables = variables,
                            .where = {}});
}

TEST(MixedTables, ColumnsAreNamedOnce) {
  const MixedFormulas formulas{parse_formula("log(u) * c + scale(u)"),
                               parse_random_terms("(1 + u | p) + (1 | p:c)")};
  EXPECT_EQ(columns_of(formulas), (std::vector<std::string>{"u", "c", "p"}));
}

TEST(MixedTables, PointsAtAColumnThatTheTableHasNot) {
  const MixedFormulas formulas{parse_formula("u * c"), parse_random_terms("1 + v | p")};
  EXPECT_EQ(unknown_in(formulas, "c", "a, b").picture, "  u * c\n      ^");
  EXPECT_EQ(unknown_in(formulas, "v", "a, b").picture, "  1 + v | p\n      ^");
  EXPECT_EQ(unknown_in(formulas, "p", "a, b").picture, "  1 + v | p\n          ^");
}

TEST(MixedTables, HistoryIsThatOfTheSamePerson) {
  TrialTable table = trials({"u", "p"}, "p,u,y\na,1,1\nb,5,0\na,2,0\na,3,1\nb,6,1\n");
  EXPECT_EQ(add_history(table, "u", "p"), 2U);
  ASSERT_EQ(table.num_rows(), 3U);
  const TrialVariable& u = *table.find("u");
  const TrialVariable& before = *table.find("previous_u");
  const TrialVariable& answer = *table.find(kPreviousAnswer);
  EXPECT_EQ(u.number(0), 2.0);
  EXPECT_EQ(before.number(0), 1.0);
  EXPECT_EQ(answer.number(0), 1.0);
  EXPECT_EQ(u.number(1), 3.0);
  EXPECT_EQ(before.number(1), 2.0);
  EXPECT_EQ(answer.number(1), 0.0);
  EXPECT_EQ(u.number(2), 6.0);
  EXPECT_EQ(before.number(2), 5.0);
  EXPECT_EQ(answer.number(2), 0.0);
}

TEST(MixedTables, HistoryNeedsTrials) {
  TrialTable table = trials({"u", "p"}, "p,u,y\na,1,1\na,2,1\n");
  table.num_trials[1] = 4.0;
  EXPECT_THROW(add_history(table, "u", "p"), core::Error);
}

TEST(MixedTables, GroupsOfTwoColumnsAreTheirPairs) {
  const MixedFormulas formulas{parse_formula("u"), parse_random_terms("1 | a:b")};
  const TrialTable table =
      trials({"u", "a", "b"}, "u,a,b,y\n1,x,1,0\n2,x,2,1\n3,y,1,1\n4,x,1,0\n");
  const MixedData data =
      mixed_data(formulas, Design(formulas.fixed, table, Contrasts::kTreatment), table,
                 Contrasts::kTreatment);
  ASSERT_EQ(data.terms.size(), 1U);
  EXPECT_EQ(data.terms[0].num_groups, 3U);
  EXPECT_EQ(data.terms[0].place, (std::vector<std::uint32_t>{0, 1, 2, 0}));
}

TEST(MixedTables, EffectsThatAreTheSameForAllAreNamedWherePeopleCouldDiffer) {
  // Everybody has both conditions, and nobody has both sexes.
  const TrialTable table = trials({"u", "c", "sex", "p"},
                                  "p,sex,c,u,y\na,f,x,1,1\na,f,z,2,0\nb,m,x,1,1\nb,m,z,2,0\n");
  const auto named = [&table](const char* random) {
    std::string names;
    for (const EffectOfAll& one : effects_of_all(
             {parse_formula("log(u) * c * sex"), parse_random_terms(random)}, table)) {
      names += one.effect + "|" + one.group + " ";
    }
    return names;
  };
  EXPECT_EQ(named("1 | p"), "log(u)|p c|p ");
  EXPECT_EQ(named("1 + log(u) | p"), "c|p ");
  EXPECT_EQ(named("(1 + u | p) + (0 + c | p)"), "");
  EXPECT_EQ(named("1 + u | p:c"), "") << "within a person's condition it does not vary";
}

TEST(MixedTables, ABarWithoutEffectsIsRefused) {
  const MixedFormulas formulas{parse_formula("u"), parse_random_terms("0 | a")};
  const TrialTable table = trials({"u", "a"}, "u,a,y\n1,x,0\n2,y,1\n");
  EXPECT_THROW(static_cast<void>(
                   mixed_data(formulas, Design(formulas.fixed, table, Contrasts::kTreatment),
                              table, Contrasts::kTreatment)),
               FormulaError);
}

}  // namespace mixed_table_test
}  // namespace jnd::analysis
