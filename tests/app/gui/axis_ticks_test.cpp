#include "app/gui/axis_ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace jnd::app::gui {
namespace axis_ticks_test {

using Labels = std::vector<std::string>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Labels labels(const std::vector<AxisTick>& ticks) {
  Labels all;
  for (const AxisTick& tick : ticks) all.push_back(tick.label);
  return all;
}

TEST(LinearTicks, AreMultiplesOfOneTwoOrFive) {
  EXPECT_EQ(labels(linear_ticks({0, 0.6}, 4)), (Labels{"0", "0.2", "0.4", "0.6"}));
  EXPECT_EQ(labels(linear_ticks({0, 15}, 5)), (Labels{"0", "5", "10", "15"}));
  EXPECT_EQ(labels(linear_ticks({0, 100}, 6)), (Labels{"0", "20", "40", "60", "80", "100"}));
  EXPECT_EQ(labels(linear_ticks({0, 100}, 4)), (Labels{"0", "50", "100"}));
  EXPECT_EQ(labels(linear_ticks({-10, 0}, 6)), (Labels{"−10", "−8", "−6", "−4", "−2", "0"}));
  EXPECT_EQ(labels(linear_ticks({0.31, 0.44}, 4)), (Labels{"0.35", "0.40"}));
  EXPECT_EQ(labels(linear_ticks({-0.05, 0.05}, 3)), (Labels{"−0.05", "0", "0.05"}));
}

TEST(LinearTicks, ValuesAreExactAndEndsCount) {
  const auto ticks = linear_ticks({0, 0.3}, 4);
  ASSERT_EQ(ticks.size(), 4u);
  EXPECT_EQ(ticks[0].value, 0.0);
  EXPECT_FALSE(std::signbit(ticks[0].value));
  EXPECT_DOUBLE_EQ(ticks[3].value, 0.3);
}

TEST(LinearTicks, LargeAndSmallNumbersArePowersOfTen) {
  EXPECT_EQ(labels(linear_ticks({0, 3e6}, 4)), (Labels{"0", "10⁶", "2×10⁶", "3×10⁶"}));
  EXPECT_EQ(labels(linear_ticks({-2e-5, 2e-5}, 3)), (Labels{"−2×10⁻⁵", "0", "2×10⁻⁵"}));
  EXPECT_EQ(labels(linear_ticks({1e9, 1.02e9}, 3)),
            (Labels{"1.00×10⁹", "1.01×10⁹", "1.02×10⁹"}));
}

TEST(LinearTicks, AreNeverMoreThanWantedAndNeverNone) {
  for (const double low : {-1e12, -3.7, 0.0, 1e-9, 41.2, 9.99e9}) {
    for (const double span : {1e-6, 0.013, 1.0, 7.7, 9999.0, 1e13}) {
      const AxisRange range = sound_range(low, low + span, false);
      for (int most = 2; most <= 10; ++most) {
        const auto ticks = linear_ticks(range, most);
        EXPECT_GE(ticks.size(), 1u) << low << " + " << span;
        EXPECT_LE(ticks.size(), static_cast<std::size_t>(most)) << low << " + " << span;
      }
    }
  }
}

TEST(LinearTicks, AnAxisIsWidenedOutToThem) {
  const AxisRange range = widened_to_ticks({0.03, 0.44}, 4);
  EXPECT_DOUBLE_EQ(range.low, 0.0);
  EXPECT_DOUBLE_EQ(range.high, 0.6);
  const AxisRange same = widened_to_ticks({0, 15}, 4);
  EXPECT_DOUBLE_EQ(same.low, 0);
  EXPECT_DOUBLE_EQ(same.high, 15);
  const AxisRange negative = widened_to_ticks({-11.2, -0.3}, 4);
  EXPECT_DOUBLE_EQ(negative.low, -15);
  EXPECT_DOUBLE_EQ(negative.high, 0);
}

TEST(LogarithmicTicks, DivideDecadesIntoRoundNumbers) {
  EXPECT_EQ(labels(logarithmic_ticks({1, 4.2}, 6)), (Labels{"1", "1.5", "2", "3", "4"}));
  EXPECT_EQ(labels(logarithmic_ticks({9, 31}, 6)), (Labels{"10", "15", "20", "30"}));
  EXPECT_EQ(labels(logarithmic_ticks({0.5, 8}, 5)), (Labels{"0.5", "1", "2", "5"}));
  EXPECT_EQ(labels(logarithmic_ticks({0.01, 100}, 5)),
            (Labels{"0.01", "0.1", "1", "10", "100"}));
}

TEST(LogarithmicTicks, SkipDecadesOverVeryWideRanges) {
  EXPECT_EQ(labels(logarithmic_ticks({1e-6, 1e6}, 5)),
            (Labels{"10⁻⁶", "0.001", "1", "1000", "10⁶"}));
}

TEST(LogarithmicTicks, AreThoseOfALinearAxisWhereItSpansLittle) {
  EXPECT_EQ(labels(logarithmic_ticks({1.61, 1.69}, 5)),
            (Labels{"1.62", "1.64", "1.66", "1.68"}));
}

TEST(LogarithmicTicks, AreNeverMoreThanWantedAndNeverNone) {
  for (const double low : {1e-140, 1e-5, 0.3, 7.0, 1e100}) {
    for (const double factor : {1.001, 1.5, 3.0, 40.0, 1e5, 1e40}) {
      for (int most = 2; most <= 10; ++most) {
        const auto ticks = logarithmic_ticks(sound_range(low, low * factor, true), most);
        EXPECT_GE(ticks.size(), 1u) << low << " * " << factor;
        EXPECT_LE(ticks.size(), static_cast<std::size_t>(most)) << low << " * " << factor;
      }
    }
  }
}

TEST(SoundRange, CanBeDrawnWhateverTheEndsAre) {
  const double ends[] = {kNan, kInfinity, -kInfinity, 0, -0.0, -3, 5, 1e308, -1e308, 1e-320};
  for (const bool logarithmic : {false, true}) {
    for (const double low : ends) {
      for (const double high : ends) {
        const AxisRange range = sound_range(low, high, logarithmic);
        EXPECT_TRUE(std::isfinite(range.low) && std::isfinite(range.high)) << low << high;
        EXPECT_LT(range.low, range.high) << low << ' ' << high;
        EXPECT_TRUE(std::isfinite(range.high - range.low));
        if (logarithmic) {
          EXPECT_GT(range.low, 0) << low << ' ' << high;
        }
        const auto ticks = logarithmic ? logarithmic_ticks(range, 5) : linear_ticks(range, 5);
        EXPECT_GE(ticks.size(), 1u) << low << ' ' << high << ' ' << logarithmic;
        EXPECT_LE(ticks.size(), 5u);
      }
    }
  }
}

TEST(SoundRange, KeepsWhatIsSoundAndTurnsWhatIsTheWrongWayRound) {
  EXPECT_EQ(sound_range(1, 2, false).low, 1);
  EXPECT_EQ(sound_range(2, 1, false).high, 2);
  EXPECT_EQ(sound_range(0, 0, false).high, 1) << "nothing yet: from zero up";
  const AxisRange around = sound_range(5, 5, false);
  EXPECT_LT(around.low, 5);
  EXPECT_GT(around.high, 5);
  EXPECT_LT(sound_range(5, 5, true).low, 5);
}

TEST(ShortNumber, HasThreeDigitsOrAllOfAWholeNumber) {
  EXPECT_EQ(short_number(0), "0");
  EXPECT_EQ(short_number(1.649), "1.65");
  EXPECT_EQ(short_number(13.58), "13.6");
  EXPECT_EQ(short_number(1240), "1240");
  EXPECT_EQ(short_number(0.04213), "0.0421");
  EXPECT_EQ(short_number(-0.5), "−0.500");
  EXPECT_EQ(short_number(1.5e8), "1.50×10⁸");
  EXPECT_EQ(short_number(2.5e-7), "2.50×10⁻⁷");
  EXPECT_EQ(short_number(kNan), "–");
}

}  // namespace axis_ticks_test
}  // namespace jnd::app::gui
