#include "experiments/order/block_turns.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

namespace jnd::experiments {
namespace block_turns_test {

using Order = std::vector<std::size_t>;

/// How often each of the blocks comes next in this many draws.
std::map<std::size_t, int> drawn(Turns turns, const std::vector<BlockProgress>& blocks,
                                 int num_draws) {
  std::map<std::size_t, int> counts;
  core::RandomStream stream(3, "test");
  for (int i = 0; i < num_draws; ++i) ++counts[next_turn(turns, blocks, stream).value()];
  return counts;
}

TEST(BlockTurns, InRoundsThoseWithTheFewestAnswersComeNext) {
  // Of the four blocks, the first is ahead by one and the last is done.
  const std::vector<BlockProgress> blocks = {{3, 7}, {2, 8}, {2, 1}, {1, 0}};
  const auto counts = drawn(Turns::kRounds, blocks, 1000);
  ASSERT_EQ(counts.size(), 2U);
  EXPECT_NEAR(counts.at(1), 500, 4 * 16) << "as likely as";
  EXPECT_NEAR(counts.at(2), 500, 4 * 16) << "one with less left";
}

TEST(BlockTurns, AtRandomEachTrialThatIsLeftIsAsLikelyAsAnother) {
  const std::vector<BlockProgress> blocks = {{9, 1}, {0, 3}, {5, 0}, {0, 6}};
  const auto counts = drawn(Turns::kRandom, blocks, 10000);
  ASSERT_EQ(counts.size(), 3U);
  EXPECT_NEAR(counts.at(0), 1000, 4 * 30);
  EXPECT_NEAR(counts.at(1), 3000, 4 * 46);
  EXPECT_NEAR(counts.at(3), 6000, 4 * 49);
}

TEST(BlockTurns, NobodyComesWhereAllAreDone) {
  core::RandomStream stream(3, "test");
  EXPECT_EQ(next_turn(Turns::kRounds, {{4, 0}, {2, 0}}, stream), std::nullopt);
  EXPECT_EQ(next_turn(Turns::kRandom, {{4, 0}, {2, 0}}, stream), std::nullopt);
  EXPECT_EQ(next_turn(Turns::kRandom, {}, stream), std::nullopt);
}

TEST(BlockTurns, EachRoundHasEveryBlockThatHasTrialsLeftOnce) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const Order order = all_turns(Turns::kRounds, {4, 2, 4}, seed, 7);
    ASSERT_EQ(order.size(), 10U);
    for (const std::size_t begin : {0U, 3U}) {
      EXPECT_EQ(std::set(order.begin() + begin, order.begin() + begin + 3),
                (std::set<std::size_t>{0, 1, 2}))
          << seed;
    }
    for (const std::size_t begin : {6U, 8U}) {
      EXPECT_EQ(std::set(order.begin() + begin, order.begin() + begin + 2),
                (std::set<std::size_t>{0, 2}))
          << seed;
    }
  }
}

// Two trials of one block and one of another have three orders.
TEST(BlockTurns, AtRandomEveryOrderIsAsLikelyAsAnother) {
  std::map<Order, int> counts;
  constexpr int kSeeds = 3000;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    ++counts[all_turns(Turns::kRandom, {2, 1}, seed, 0)];
  }
  ASSERT_EQ(counts.size(), 3U);
  for (const auto& [order, count] : counts) EXPECT_NEAR(count, 1000, 4 * 26);
}

TEST(BlockTurns, AreAnothersForAnotherSeedAndAnotherGroup) {
  const std::vector<int> num_trials = {8, 8, 8};
  const Order order = all_turns(Turns::kRounds, num_trials, 1, 4);
  EXPECT_EQ(order, all_turns(Turns::kRounds, num_trials, 1, 4));
  EXPECT_NE(order, all_turns(Turns::kRounds, num_trials, 2, 4));
  EXPECT_NE(order, all_turns(Turns::kRounds, num_trials, 1, 5));
}

TEST(BlockTurns, AGroupIsRunTogetherAndTwiceWhereItComesTwice) {
  Stage before{.name = "before"}, a{.name = "a"}, b{.name = "b"}, c{.name = "c"};
  a.interleaving = b.interleaving = Interleaving{.name = "group", .title = {}};
  c.interleaving = Interleaving{.name = "another", .title = {}};
  const std::vector<const Stage*> stages = {&before, &a, &b, &a, &b, &c, &before};
  EXPECT_EQ(num_run_together(stages, 0), 1U);
  EXPECT_EQ(num_run_together(stages, 1), 2U);
  EXPECT_EQ(num_run_together(stages, 3), 2U);
  EXPECT_EQ(num_run_together(stages, 5), 1U);
  EXPECT_EQ(num_run_together(stages, 6), 1U);
  EXPECT_EQ(num_run_together(stages, 7), 1U) << "after the last";
}

}  // namespace block_turns_test
}  // namespace jnd::experiments
