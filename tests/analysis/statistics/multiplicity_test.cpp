#include "analysis/statistics/multiplicity.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace jnd::analysis {
namespace multiplicity_test {

TEST(HolmAdjusted, IsWorkedByHandAndKeepsTheOrderGiven) {
  // In ascending order, 0.01, 0.02, 0.04 times 3, 2, 1, never falling, are 0.03, 0.04, 0.04.
  const auto adjusted = holm_adjusted({0.04, 0.01, 0.02});
  EXPECT_DOUBLE_EQ(adjusted[0].value(), 0.04);
  EXPECT_DOUBLE_EQ(adjusted[1].value(), 0.03);
  EXPECT_DOUBLE_EQ(adjusted[2].value(), 0.04);
}

TEST(HolmAdjusted, DoesNotCountATestThatCouldNotBeMade) {
  const auto adjusted = holm_adjusted({0.03, std::nullopt, 0.5});
  EXPECT_DOUBLE_EQ(adjusted[0].value(), 0.06);
  EXPECT_FALSE(adjusted[1].has_value());
  EXPECT_DOUBLE_EQ(adjusted[2].value(), 0.5);
}

TEST(HolmAdjusted, NeverExceedsOneNorFallsBelowWhatItWas) {
  const std::vector<std::optional<double>> p_values = {0.9, 0.8, 0.0, 0.3, 0.3, 1.0};
  const auto adjusted = holm_adjusted(p_values);
  for (std::size_t i = 0; i < p_values.size(); ++i) {
    EXPECT_GE(*adjusted[i], *p_values[i]);
    EXPECT_LE(*adjusted[i], 1.0);
  }
  EXPECT_TRUE(holm_adjusted({}).empty());
}

TEST(HolmAdjusted, RefusesWhatIsNoProbability) {
  EXPECT_THROW((void)holm_adjusted({1.1}), core::Error);
  EXPECT_THROW((void)holm_adjusted({-0.1}), core::Error);
  EXPECT_THROW((void)holm_adjusted({std::nan("")}), core::Error);
}

}  // namespace multiplicity_test
}  // namespace jnd::analysis
