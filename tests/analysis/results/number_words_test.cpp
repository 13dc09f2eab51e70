#include "analysis/results/number_words.h"

#include <gtest/gtest.h>

#include <limits>

namespace jnd::analysis {
namespace number_words_test {

TEST(ReportWords, ANumberHasFourSignificantDigits) {
  EXPECT_EQ(number_words(0.69741), "0.6974");
  EXPECT_EQ(number_words(1.23456), "1.235");
  EXPECT_EQ(number_words(16.0601), "16.06");
  EXPECT_EQ(number_words(123.456), "123.5");
  EXPECT_EQ(number_words(12345.6), "12346");
  EXPECT_EQ(number_words(0.000123), "0.000123");
}

TEST(ReportWords, AWholeNumberIsACountAndHasNoDecimals) {
  EXPECT_EQ(number_words(0.0), "0");
  EXPECT_EQ(number_words(13.0), "13");
  EXPECT_EQ(number_words(-2.0), "−2");
}

TEST(ReportWords, WhatIsNotThereOrNotFiniteIsADash) {
  EXPECT_EQ(number_words(std::nullopt), "–");
  EXPECT_EQ(number_words(std::numeric_limits<double>::quiet_NaN()), "–");
  EXPECT_EQ(number_words(std::numeric_limits<double>::infinity(), 2), "–");
  EXPECT_EQ(interval_words({}, 0.5), "–");
  EXPECT_EQ(p_words(std::nullopt), "–");
}

TEST(ReportWords, MinusIsTypesetAndMinusNothingIsNothing) {
  EXPECT_EQ(number_words(-0.5), "−0.5000");
  EXPECT_EQ(number_words(-0.0001, 2), "0.00");
}

TEST(ReportWords, AnIntervalHasNoMoreDecimalsThanItsValueAndSaysWhereItIsOpen) {
  EXPECT_EQ(interval_words({0.59321, 12.5}, 0.6974), "0.5932\u00a0to\u00a012.50");
  EXPECT_EQ(interval_words({0.4, 1203.4}, 1.605), "0.400\u00a0to\u00a01203");
  EXPECT_EQ(interval_words({0.4, 402366.9}, 1.605), "from\u00a00.400") << "no statement";
  EXPECT_EQ(interval_words({std::nullopt, 1.5}, 1.2), "up\u00a0to\u00a01.500");
  EXPECT_EQ(interval_words({0.25, std::nullopt}, 0.6974), "from\u00a00.2500");
}

TEST(ReportWords, ASmallProbabilityIsSaidToBeSmallerThanAThousandth) {
  EXPECT_EQ(p_words(0.00099), "< 0.001");
  EXPECT_EQ(p_words(0.0214), "0.021");
}

TEST(ReportWords, PublishedDigitsStayAsTheyWerePrinted) {
  EXPECT_EQ(shortest_words(0.697), "0.697");
  EXPECT_EQ(shortest_words(-2.0), "−2");
}

TEST(ReportWords, CellsAreReadWithoutTheSignsOfAProgram) {
  EXPECT_EQ(cell_words("priming=primed;method_order=estimation,production"),
            "priming: primed; method order: estimation, production");
  EXPECT_EQ(cell_words(""), "–");
}

TEST(ReportWords, TimesAreThoseOfPeople) {
  EXPECT_EQ(duration_words(41.2), "41 s");
  EXPECT_EQ(duration_words(750.0), "13 min");
  EXPECT_EQ(duration_words(3900.0), "1 h 05 min");
  EXPECT_EQ(date_words(0), "1970-01-01");
  EXPECT_EQ(date_words(1'542'000'000'000'000'000), "2018-11-12");
}

}  // namespace number_words_test
}  // namespace jnd::analysis
