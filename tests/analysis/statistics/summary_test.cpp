#include "analysis/statistics/summary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace summary_test {

TEST(Summary, IsWorkedByHand) {
  const Summary summary = summary_of({4, 1, 3, 2});
  EXPECT_EQ(summary.num_values, 4);
  EXPECT_DOUBLE_EQ(*summary.mean, 2.5);
  EXPECT_DOUBLE_EQ(*summary.standard_deviation, std::sqrt(5.0 / 3.0));
  EXPECT_DOUBLE_EQ(*summary.median, 2.5);
  // t(3) = 3.182446 at 97.5 %.
  EXPECT_NEAR(*summary.mean_ci95.high, 2.5 + 3.182446305284263 * std::sqrt(5.0 / 12.0), 1e-12);
}

TEST(Summary, TooFewValuesLeaveOutWhatTheyDoNotDefine) {
  EXPECT_FALSE(summary_of({}).mean.has_value());
  const Summary one = summary_of({7.0});
  EXPECT_DOUBLE_EQ(*one.mean, 7.0);
  EXPECT_FALSE(one.standard_deviation.has_value());
  EXPECT_FALSE(one.mean_ci95.low.has_value());
  EXPECT_THROW((void)summary_of({1.0, std::nan("")}), core::Error);
}

TEST(Summary, PercentilesInterpolateBetweenNeighbours) {
  const std::vector<double> values = {1, 2, 4, 8};
  EXPECT_DOUBLE_EQ(percentile(values, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(percentile(values, 0.5), 3.0);
  EXPECT_DOUBLE_EQ(percentile(values, 1.0), 8.0);
  EXPECT_TRUE(std::isinf(percentile({1.0, HUGE_VAL}, 0.5)));
}

TEST(ResampleParticipants, GivesTheTIntervalOfAMeanForManyParticipants) {
  core::RandomStream random(3, "summary test");
  std::vector<double> values(400);
  for (double& value : values) value = random.normal(5.0, 2.0);
  const auto mean = [&](const std::vector<std::size_t>& drawn) -> std::optional<double> {
    double sum = 0.0;
    for (const std::size_t participant : drawn) sum += values[participant];
    return sum / static_cast<double>(drawn.size());
  };
  const ResampledInterval found = resample_participants(values.size(), 4000, 1, mean);
  const Summary summary = summary_of(values);
  EXPECT_NEAR(*found.ci95.low, *summary.mean_ci95.low, 0.02);
  EXPECT_NEAR(*found.ci95.high, *summary.mean_ci95.high, 0.02);
  const ResampledInterval again = resample_participants(values.size(), 4000, 1, mean);
  EXPECT_EQ(*found.ci95.low, *again.ci95.low);
}

TEST(ResampleParticipants, DrawsAsManyAsThereAreAndEachAsOften) {
  std::vector<int> times(7, 0);
  (void)resample_participants(7, 3000, 2, [&](const std::vector<std::size_t>& drawn) {
    EXPECT_EQ(drawn.size(), 7U);
    for (const std::size_t participant : drawn) ++times.at(participant);
    return std::optional<double>(1.0);
  });
  for (const int count : times) EXPECT_NEAR(count, 3000, 250);
}

TEST(ResampleParticipants, GivesNoIntervalForFewerThanFive) {
  const auto first = [](const std::vector<std::size_t>& drawn) {
    return std::optional<double>(static_cast<double>(drawn[0]));
  };
  EXPECT_FALSE(resample_participants(4, 100, 1, first).ci95.low.has_value());
  EXPECT_TRUE(resample_participants(5, 100, 1, first).ci95.low.has_value());
}

/// For the geometric mean, the logarithms 0, ..., 7 have the mean 3.5 and the standard
/// deviation sqrt(6), and t is 2.3646 with 7 degrees of freedom.
TEST(ResampleFactor, GivesTheTIntervalOfAGeometricMean) {
  const auto geometric_mean = [](const std::vector<std::size_t>& drawn) {
    double sum = 0.0;
    for (const std::size_t place : drawn) sum += static_cast<double>(place);
    return std::optional(std::exp(sum / static_cast<double>(drawn.size())));
  };
  const Interval ci95 = resample_factor(8, 20000, 1, std::exp(3.5), geometric_mean).ci95;
  const double reach = 2.3646 * std::sqrt(6.0) / std::sqrt(8.0);
  EXPECT_NEAR(std::log(*ci95.low), 3.5 - reach, 0.02 * reach);
  EXPECT_NEAR(std::log(*ci95.high), 3.5 + reach, 0.02 * reach);
  EXPECT_FALSE(resample_factor(4, 100, 1, 1.0, geometric_mean).ci95.low);
}

/// A few resamples without bound are no reason for an open end.
TEST(ResampleFactor, ManyInfiniteResamplesOpenTheEnd) {
  const auto beyond = [](std::size_t many) {
    return [many](const std::vector<std::size_t>& drawn) -> std::optional<double> {
      const auto num_first = std::ranges::count(drawn, std::size_t{0});
      if (static_cast<std::size_t>(num_first) >= many) {
        return std::numeric_limits<double>::infinity();
      }
      return 1.0 + 0.1 * static_cast<double>(num_first);
    };
  };
  // If 10 are drawn from 10, a given one appears twice or more in 26 %, and five times or more
  // in 0.2 %.
  EXPECT_FALSE(resample_factor(10, 2000, 1, 1.1, beyond(2)).ci95.high);
  EXPECT_TRUE(resample_factor(10, 2000, 1, 1.1, beyond(5)).ci95.high);
  EXPECT_THROW((void)resample_factor(10, 10, 1, 0.0, beyond(5)), core::Error);
}

TEST(ResampleParticipants, CountsResamplesThatAreUndefinedAndGivesUpAtHalf) {
  int call = 0;
  const auto some = resample_participants(7, 100, 1, [&](const std::vector<std::size_t>&) {
    ++call;
    return call % 4 == 0 ? std::nullopt : std::optional<double>(call);
  });
  EXPECT_EQ(some.num_undefined, 25);
  EXPECT_TRUE(some.ci95.low.has_value());
  const auto none = resample_participants(7, 100, 1, [&](const std::vector<std::size_t>&) {
    return std::optional<double>(std::nan(""));
  });
  EXPECT_EQ(none.num_undefined, 100);
  EXPECT_FALSE(none.ci95.low.has_value());
  EXPECT_THROW((void)resample_participants(
                   0, 1, 1, [](const auto&) { return std::optional<double>(1.0); }),
               core::Error);
}

TEST(ResampleParticipants, SeveralStatisticsHaveTheIntervalsThatEachHasAlone) {
  const std::vector<double> values = {0.4, 1.7, 2.2, 3.1, 4.6, 5.5, 9.0};
  const auto mean = [&](const std::vector<std::size_t>& drawn) -> std::optional<double> {
    double sum = 0.0;
    for (const std::size_t place : drawn) sum += values[place];
    return sum / static_cast<double>(drawn.size());
  };
  const auto first = [&](const std::vector<std::size_t>& drawn) -> std::optional<double> {
    return drawn[0] == 0 ? std::nullopt : std::optional(values[drawn[0]]);
  };
  const ResampledStatistics both = [&](const std::vector<std::size_t>& drawn,
                                       std::span<std::optional<double>> found) {
    found[0] = mean(drawn);
    found[1] = first(drawn);
  };
  const auto expect_same = [](const ResampledInterval& found,
                              const ResampledInterval& expected) {
    EXPECT_EQ(found.ci95.low, expected.ci95.low);
    EXPECT_EQ(found.ci95.high, expected.ci95.high);
    EXPECT_EQ(found.num_undefined, expected.num_undefined);
  };
  const auto percentiles = resample_participants(values.size(), 300, 4, 2, both);
  expect_same(percentiles.at(0), resample_participants(values.size(), 300, 4, mean));
  expect_same(percentiles.at(1), resample_participants(values.size(), 300, 4, first));
  EXPECT_GT(percentiles.at(1).num_undefined, 0);
  const auto factors = resample_factors(values.size(), 300, 4, {3.5, 2.0}, both);
  expect_same(factors.at(0), resample_factor(values.size(), 300, 4, 3.5, mean));
  expect_same(factors.at(1), resample_factor(values.size(), 300, 4, 2.0, first));
}

}  // namespace summary_test
}  // namespace jnd::analysis
