#include "experiments/adaptive/level_scale.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"

namespace jnd::experiments {
namespace level_scale_test {

constexpr auto kLinear = LevelScale::kLinear;
constexpr auto kLogarithmic = LevelScale::kLogarithmic;

TEST(LevelScale, TakesMiddlesInItsScale) {
  EXPECT_EQ(midpoint(kLinear, 2.0, 8.0), 5.0);
  EXPECT_NEAR(midpoint(kLogarithmic, 2.0, 8.0), 4.0, 1e-14);
  EXPECT_EQ(mean_level(kLinear, {1.0, 2.0, 6.0}), 3.0);
  EXPECT_NEAR(mean_level(kLogarithmic, {1.0, 2.0, 32.0}), 4.0, 1e-14);
}

TEST(LevelScale, SpacesLevelsEquallyAndKeepsTheEndsToTheBit) {
  EXPECT_EQ(equally_spaced(kLinear, 1.0, 3.0, 5), (std::vector<double>{1, 1.5, 2, 2.5, 3}));
  const auto levels = equally_spaced(kLogarithmic, 0.1, 0.7, 20);
  ASSERT_EQ(levels.size(), 20u);
  EXPECT_EQ(levels.front(), 0.1);
  EXPECT_EQ(levels.back(), 0.7);
  for (std::size_t i = 1; i < levels.size(); ++i) {
    EXPECT_NEAR(std::log(levels[i] / levels[i - 1]), std::log(7.0) / 19, 1e-12);
  }
}

TEST(LevelScale, RefusesWhatIsNoLevel) {
  EXPECT_THROW(require_level(kLogarithmic, "level", 0.0), core::Error);
  EXPECT_NO_THROW(require_level(kLinear, "level", 0.0));
  EXPECT_THROW(require_level(kLinear, "level", std::numeric_limits<double>::infinity()),
               core::Error);
  EXPECT_THROW((void)equally_spaced(kLinear, 1.0, 1.0, 5), core::Error);
  EXPECT_THROW((void)equally_spaced(kLinear, 1.0, 2.0, 1), core::Error);
  EXPECT_THROW((void)equally_spaced(kLogarithmic, 0.0, 2.0, 3), core::Error);
}

}  // namespace level_scale_test
}  // namespace jnd::experiments
