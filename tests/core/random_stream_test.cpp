#include "core/random_stream.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

namespace jnd::core {
namespace random_stream_test {

/// SplitMix64 as Vigna published it.
struct SplitMix64 {
  std::uint64_t state;
  std::uint64_t next() {
    std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
};

TEST(RandomStream, IsSplitMix64StartedFromTheHashOfItsKey) {
  // These are the published first outputs for the state 1234567.
  SplitMix64 published{1234567};
  EXPECT_EQ(published.next(), 6457827717110365317ULL);
  EXPECT_EQ(published.next(), 3203168211198807973ULL);

  SplitMix64 reference{derived_seed(42, "order", {3, 1})};
  RandomStream stream(42, "order", {3, 1});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(stream.next_bits(), reference.next());
}

TEST(RandomStream, TheSameKeyGivesTheSameNumbers) {
  RandomStream one(1, "stroke", {1, 2, 3});
  RandomStream two(1, "stroke", {1, 2, 3});
  for (int i = 0; i < 100; ++i) EXPECT_EQ(one.next_bits(), two.next_bits());
}

TEST(RandomStream, EveryPartOfTheKeyCounts) {
  std::set<std::uint64_t> seeds;
  int num_keys = 0;
  for (const std::uint64_t seed : {0ULL, 1ULL, 2ULL}) {
    for (const char* purpose : {"", "a", "b", "ab", "ba"}) {
      seeds.insert(derived_seed(seed, purpose));
      ++num_keys;
      for (const std::int64_t first : {-1, 0, 1}) {
        seeds.insert(derived_seed(seed, purpose, {first}));
        ++num_keys;
        for (const std::int64_t second : {-1, 0, 1}) {
          seeds.insert(derived_seed(seed, purpose, {first, second}));
          ++num_keys;
        }
      }
    }
  }
  // A letter must not have the same effect as an index.
  seeds.insert(derived_seed(0, "a", {98}));
  EXPECT_EQ(static_cast<int>(seeds.size()), num_keys + 1);
}

TEST(RandomStream, UniformNumbersFillTheHalfOpenInterval) {
  RandomStream stream(5, "uniform");
  std::array<int, 10> bins{};
  for (int i = 0; i < 100'000; ++i) {
    const double x = stream.uniform();
    ASSERT_GE(x, 0.0);
    ASSERT_LT(x, 1.0);
    ++bins[static_cast<std::size_t>(x * 10.0)];
  }
  // 400 is more than four standard deviations.
  for (const int count : bins) EXPECT_NEAR(count, 10'000, 400);
  for (int i = 0; i < 1000; ++i) {
    const double x = stream.uniform(-2.0, 3.0);
    EXPECT_GE(x, -2.0);
    EXPECT_LT(x, 3.0);
  }
}

TEST(RandomStream, NormalNumbersHaveTheirMomentsAndTails) {
  RandomStream stream(6, "normal");
  const int n = 200'000;
  double sum = 0.0, squares = 0.0, fourth = 0.0;
  int beyond_two = 0;
  for (int i = 0; i < n; ++i) {
    const double z = stream.normal();
    ASSERT_TRUE(std::isfinite(z));
    sum += z;
    squares += z * z;
    fourth += z * z * z * z;
    beyond_two += std::abs(z) > 2.0 ? 1 : 0;
  }
  EXPECT_NEAR(sum / n, 0.0, 0.01);
  EXPECT_NEAR(squares / n, 1.0, 0.015);
  EXPECT_NEAR(fourth / n, 3.0, 0.12);
  EXPECT_NEAR(static_cast<double>(beyond_two) / n, 0.0455, 0.002);
  RandomStream shifted(6, "normal");
  RandomStream plain(6, "normal");
  EXPECT_DOUBLE_EQ(shifted.normal(5.0, 2.0), 5.0 + 2.0 * plain.normal());
}

TEST(RandomStream, BelowGivesEveryValueEquallyOften) {
  RandomStream stream(7, "below");
  std::array<int, 3> counts{};
  for (int i = 0; i < 30'000; ++i) ++counts[stream.below(3)];
  for (const int count : counts) EXPECT_NEAR(count, 10'000, 350);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(stream.below(1), 0U);
}

TEST(RandomStream, AShuffleGivesEveryOrderEquallyOften) {
  RandomStream stream(8, "shuffle");
  std::map<std::vector<int>, int> counts;
  for (int i = 0; i < 24'000; ++i) {
    std::vector<int> items = {1, 2, 3, 4};
    stream.shuffle(items);
    ++counts[items];
  }
  EXPECT_EQ(counts.size(), 24U);
  for (const auto& [order, count] : counts) EXPECT_NEAR(count, 1000, 150);
}

TEST(RandomStream, AProbabilityOfZeroOrOneIsCertain) {
  RandomStream stream(9, "chance");
  int hits = 0;
  for (int i = 0; i < 10'000; ++i) {
    EXPECT_FALSE(stream.with_probability(0.0));
    EXPECT_TRUE(stream.with_probability(1.0));
    hits += stream.with_probability(0.3) ? 1 : 0;
  }
  EXPECT_NEAR(hits, 3000, 200);
}

}  // namespace random_stream_test
}  // namespace jnd::core
