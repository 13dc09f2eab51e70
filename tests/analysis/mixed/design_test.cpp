#include "analysis/mixed/design.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace jnd::analysis {
namespace design_test {

/// Returns six rows: u = 1..6, condition B A C B A C, day 2 10 2 10 2 10.
TrialTable six_rows() {
  return parse_trial_table(
      "u,condition,day,y\n1,B,2,1\n2,A,10,0\n3,C,2,1\n4,B,10,1\n5,A,2,0\n6,C,10,1\n", "six.csv",
      {.answers = {.yes = "y", .yes_value = {}, .trials = {}},
       .variables = {"u", "condition", "day"},
       .where = {}});
}

using Names = std::vector<std::string>;

Names names_of(const std::string& formula, Contrasts contrasts = Contrasts::kTreatment) {
  return Design(parse_formula(formula), six_rows(), contrasts).names();
}

TEST(Design, NamesColumnsAsRDoes) {
  EXPECT_EQ(names_of("u * condition"), (Names{"(Intercept)", "u", "conditionB", "conditionC",
                                              "u:conditionB", "u:conditionC"}));
  EXPECT_EQ(
      names_of("u * condition", Contrasts::kSum),
      (Names{"(Intercept)", "u", "condition1", "condition2", "u:condition1", "u:condition2"}));
  EXPECT_EQ(names_of("0 + condition"), (Names{"conditionA", "conditionB", "conditionC"}));
  // Without the intercept, sum contrasts have nothing to contrast with.
  EXPECT_EQ(names_of("0 + condition", Contrasts::kSum),
            (Names{"conditionA", "conditionB", "conditionC"}));
  EXPECT_EQ(names_of("condition + u:condition"),
            (Names{"(Intercept)", "conditionB", "conditionC", "conditionA:u", "conditionB:u",
                   "conditionC:u"}));
  EXPECT_EQ(names_of("factor(day)"), (Names{"(Intercept)", "factor(day)10"}));
  EXPECT_EQ(names_of("day"), (Names{"(Intercept)", "day"}));
  EXPECT_EQ(names_of("log(u) + scale(u)"), (Names{"(Intercept)", "log(u)", "scale(u)"}));
  // The first factor of a product varies fastest.
  EXPECT_EQ(names_of("condition:factor(day)"),
            (Names{"(Intercept)", "conditionA:factor(day)2", "conditionB:factor(day)2",
                   "conditionC:factor(day)2", "conditionA:factor(day)10",
                   "conditionB:factor(day)10", "conditionC:factor(day)10"}));
}

TEST(Design, TreatmentContrastsAreAgainstTheFirstLevel) {
  const TrialTable table = six_rows();
  const Eigen::MatrixXd x =
      Design(parse_formula("u * condition"), table, Contrasts::kTreatment).matrix(table);
  Eigen::MatrixXd expected(6, 6);
  expected << 1, 1, 1, 0, 1, 0,  //
      1, 2, 0, 0, 0, 0,          //
      1, 3, 0, 1, 0, 3,          //
      1, 4, 1, 0, 4, 0,          //
      1, 5, 0, 0, 0, 0,          //
      1, 6, 0, 1, 0, 6;
  EXPECT_EQ(x, expected);
}

TEST(Design, SumContrastsAreAgainstTheMeanOfAllLevels) {
  const TrialTable table = six_rows();
  const Eigen::MatrixXd x =
      Design(parse_formula("condition"), table, Contrasts::kSum).matrix(table);
  Eigen::MatrixXd expected(6, 3);
  expected << 1, 0, 1,  //
      1, 1, 0,          //
      1, -1, -1,        //
      1, 0, 1,          //
      1, 1, 0,          //
      1, -1, -1;
  EXPECT_EQ(x, expected);
}

TEST(Design, LevelsOfNumbersAreInTheirOrder) {
  const TrialTable table = six_rows();
  const Design design(parse_formula("factor(day)"), table, Contrasts::kTreatment);
  EXPECT_EQ(design.variables()[0].levels, (Names{"2", "10"}));
  EXPECT_EQ(design.matrix(table).col(1), (Eigen::VectorXd(6) << 0, 1, 0, 1, 0, 1).finished());
}

TEST(Design, FunctionsAreThoseOfTheRows) {
  const TrialTable table = six_rows();
  const Design design(parse_formula("scale(u) + center(u) + log2(u)"), table,
                      Contrasts::kTreatment);
  const Eigen::MatrixXd x = design.matrix(table);
  // The mean is 3.5, and the standard deviation of 1 to 6 is the root of 3.5.
  EXPECT_NEAR(x(0, 1), -2.5 / std::sqrt(3.5), 1e-15);
  EXPECT_EQ(x(0, 2), -2.5);
  EXPECT_EQ(x(3, 3), 2.0);
  EXPECT_NEAR(design.variables()[0].transformed(7.0), 3.5 / std::sqrt(3.5), 1e-15);
}

TEST(Design, RefusesWhatHasNoColumns) {
  const TrialTable table =
      parse_trial_table("u,c,y\n0,a,1\n1,a,0\nx,a,0\n", "t.csv",
                        {.answers = {.yes = "y", .yes_value = {}, .trials = {}},
                         .variables = {"u", "c"},
                         .where = {}});
  for (const auto& [formula, words] :
       {std::pair<const char*, const char*>{"log(u)", "numbers alone in the column u"},
        {"c", "a factor of two levels or more, found a alone"},
        {"scale(c)", "numbers alone"}}) {
    try {
      const Design design(parse_formula(formula), table, Contrasts::kTreatment);
      FAIL() << formula;
    } catch (const FormulaError& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  }
  const TrialTable zero =
      parse_trial_table("u,y\n0,1\n1,0\n", "t.csv",
                        {.answers = {.yes = "y", .yes_value = {}, .trials = {}},
                         .variables = {"u"},
                         .where = {}});
  EXPECT_THROW(Design(parse_formula("log(u)"), zero, Contrasts::kTreatment), FormulaError);
}

}  // namespace design_test
}  // namespace jnd::analysis
