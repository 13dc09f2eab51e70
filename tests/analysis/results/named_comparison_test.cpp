#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "analysis/results/study_results.h"

namespace named_comparison_test {

using namespace jnd::analysis;
using ::testing::DoubleNear;
using ::testing::Optional;

NamedComparison of_logarithms() {
  NamedComparison named{.name = "a - b: ln match, paired", .ratio_of = "match"};
  named.comparison.estimate = std::log(2.0);
  named.comparison.ci95 = {0.0, std::log(4.0)};
  return named;
}

TEST(NamedComparison, ADifferenceOfLogarithmsIsARatioWithItsInterval) {
  const NamedComparison named = of_logarithms();
  EXPECT_THAT(named.ratio(), Optional(DoubleNear(2.0, 1e-12)));
  EXPECT_THAT(named.ratio_ci95().low, Optional(DoubleNear(1.0, 1e-12)));
  EXPECT_THAT(named.ratio_ci95().high, Optional(DoubleNear(4.0, 1e-12)));
}

TEST(NamedComparison, TheRatioOfARankTestIsThatOfHodgesAndLehmann) {
  NamedComparison named = of_logarithms();
  named.comparison.hodges_lehmann = std::log(3.0);
  named.comparison.hodges_lehmann_ci95 = {std::log(1.5), std::nullopt};
  EXPECT_THAT(named.ratio(), Optional(DoubleNear(3.0, 1e-12)));
  EXPECT_THAT(named.ratio_ci95().low, Optional(DoubleNear(1.5, 1e-12)));
  EXPECT_FALSE(named.ratio_ci95().high.has_value());
}

TEST(NamedComparison, WithoutLogarithmsOrAnEstimateThereIsNoRatio) {
  NamedComparison named = of_logarithms();
  named.comparison.estimate.reset();
  EXPECT_FALSE(named.ratio().has_value());
  named = of_logarithms();
  named.ratio_of.clear();
  EXPECT_FALSE(named.ratio().has_value());
  EXPECT_FALSE(named.ratio_ci95().low.has_value());
}

}  // namespace named_comparison_test
