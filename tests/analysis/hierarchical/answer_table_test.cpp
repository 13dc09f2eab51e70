#include "analysis/hierarchical/answer_table.h"

#include <gtest/gtest.h>

#include <cmath>

namespace jnd::analysis {
namespace answer_table_test {

constexpr double kLapseRates[] = {0.0, 1e-12, 1e-6, 1e-3, 0.03, 0.3};
constexpr double kGuessRates[] = {0.0, 1.0 / 3.0, 0.5};
/// No multiple of the step is a knot, and the range goes beyond both ends of the table.
constexpr double kStep = 0.00719, kFarthest = 12.0;

TEST(AnswerTable, HasTheLogarithmsOfTheFunctionToTenDecimals) {
  AnswerTable table;
  for (const double guess_rate : kGuessRates) {
    for (const double lapse_rate : kLapseRates) {
      table.set(lapse_rate, guess_rate);
      for (double z = -kFarthest; z < kFarthest; z += kStep) {
        const AnswerProbabilities expected = answer_probabilities(z, lapse_rate, guess_rate);
        const AnswerProbabilities found = table.at(z, {});
        ASSERT_NEAR(found.log_yes, expected.log_yes, 1e-10) << z << ' ' << lapse_rate;
        ASSERT_NEAR(found.log_no, expected.log_no, 1e-10) << z << ' ' << lapse_rate;
        ASSERT_NEAR(found.by_z_yes, expected.by_z_yes, 1e-7) << z << ' ' << lapse_rate;
        ASSERT_NEAR(found.by_z_no, expected.by_z_no, 1e-7) << z << ' ' << lapse_rate;
      }
    }
  }
}

TEST(AnswerTable, HasTheDerivativesByTheLapseRate) {
  AnswerTable table;
  for (const double guess_rate : kGuessRates) {
    for (const double lapse_rate : {1e-6, 0.03, 0.3}) {
      table.set(lapse_rate, guess_rate);
      for (double z = -6.0; z < 6.0; z += kStep) {
        const AnswerProbabilities expected = answer_probabilities(z, lapse_rate, guess_rate);
        const AnswerProbabilities found = table.at(z, {});
        ASSERT_NEAR(found.by_lapse_yes / (1.0 + std::fabs(expected.by_lapse_yes)),
                    expected.by_lapse_yes / (1.0 + std::fabs(expected.by_lapse_yes)), 1e-9);
        ASSERT_NEAR(found.by_lapse_no / (1.0 + std::fabs(expected.by_lapse_no)),
                    expected.by_lapse_no / (1.0 + std::fabs(expected.by_lapse_no)), 1e-9);
      }
    }
  }
}

TEST(AnswerTable, ItsSlopeIsThatOfItsOwnValue) {
  AnswerTable table;
  table.set(0.02, 0.0);
  constexpr double kAside = 1e-5;
  for (double z = -8.0; z < 8.0; z += 0.0371) {
    const double rise =
        (table.at(z + kAside, {}).log_yes - table.at(z - kAside, {}).log_yes) / (2.0 * kAside);
    ASSERT_NEAR(table.at(z, {}).by_z_yes, rise, 1e-8) << z;
  }
}

TEST(AnswerTable, GoesOverToOtherRates) {
  AnswerTable table;
  table.set(0.1, 0.0);
  table.set(0.01, 0.0);
  EXPECT_NEAR(table.at(0.3, {}).log_yes, answer_probabilities(0.3, 0.01, 0.0).log_yes, 1e-10);
  table.set(0.01, 0.5);
  EXPECT_NEAR(table.at(0.3, {}).log_yes, answer_probabilities(0.3, 0.01, 0.5).log_yes, 1e-10);
}

TEST(AnswerTable, LeavesOutWhatIsNotAskedFor) {
  AnswerTable table;
  table.set(0.02, 0.0);
  const AnswerProbabilities yes = table.at(1.0, {.of_no = false});
  const AnswerProbabilities no = table.at(1.0, {.of_yes = false});
  EXPECT_EQ(yes.by_z_no, 0.0);
  EXPECT_EQ(no.by_z_yes, 0.0);
  EXPECT_GT(yes.by_z_yes, 0.0);
  EXPECT_GT(no.by_z_no, 0.0);
}

TEST(AnswerTable, LeavesOutDerivativesThatAreNotAskedFor) {
  AnswerTable table;
  table.set(0.02, 0.0);
  const AnswerProbabilities all = table.at(1.0, {});
  const AnswerProbabilities by_z = table.at(1.0, {.by_lapse = false});
  EXPECT_EQ(by_z.by_z_yes, all.by_z_yes);
  EXPECT_EQ(by_z.by_lapse_yes, 0.0);
  const AnswerProbabilities values = table.at(1.0, {.by_z = false, .by_lapse = false});
  EXPECT_EQ(values.log_no, all.log_no);
  EXPECT_EQ(values.by_z_no, 0.0);
}

TEST(AnswerTable, EndsJustBelowTheLastKnot) {
  AnswerTable table;
  table.set(0.02, 0.0);
  for (const double end : {-10.0, 10.0}) {
    for (const double z : {std::nextafter(end, 0.0), end, std::nextafter(end, 2.0 * end)}) {
      EXPECT_NEAR(table.at(z, {}).log_yes, answer_probabilities(z, 0.02, 0.0).log_yes, 1e-10);
    }
  }
}

}  // namespace answer_table_test
}  // namespace jnd::analysis
