#include "experiments/order/stimulus_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"

namespace jnd::experiments {
namespace stimulus_order_test {

using Method = StimulusOrder::Method;
using Order = std::vector<std::size_t>;

std::vector<double> stimuli(std::size_t num) {
  std::vector<double> values;
  for (std::size_t i = 0; i < num; ++i) values.push_back(10.0 + static_cast<double>(i));
  return values;
}

Order order_of(const StimulusOrder& rule, std::size_t num_stimuli, int num_repetitions,
               std::int64_t draw = 0) {
  core::RandomStream stream(7, "test", {draw});
  return stimulus_order(rule, stimuli(num_stimuli), num_repetitions, stream);
}

/// Returns the smallest number of trials from a stimulus to its next presentation, or
/// `order.size()` if no stimulus returns.
std::size_t least_distance(const Order& order) {
  std::size_t least = order.size();
  std::map<std::size_t, std::size_t> last;
  for (std::size_t place = 0; place < order.size(); ++place) {
    if (last.contains(order[place])) least = std::min(least, place - last[order[place]]);
    last[order[place]] = place;
  }
  return least;
}

bool holds_every_stimulus_once(const Order& order, std::size_t begin, std::size_t num) {
  Order part(order.begin() + static_cast<std::ptrdiff_t>(begin),
             order.begin() + static_cast<std::ptrdiff_t>(begin + num));
  std::sort(part.begin(), part.end());
  for (std::size_t i = 0; i < num; ++i) {
    if (part[i] != i) return false;
  }
  return true;
}

/// Returns chi-square of counts that should be equal, divided by its degrees of freedom. It
/// should be about 1.
double unevenness(const std::map<Order, int>& counts, double num_draws) {
  const double expected = num_draws / static_cast<double>(counts.size());
  double sum = 0.0;
  for (const auto& [order, count] : counts) sum += std::pow(count - expected, 2.0) / expected;
  return sum / static_cast<double>(counts.size() - 1);
}

TEST(StimulusOrder, WithoutARuleIsTheShuffleOfEachRepetition) {
  core::RandomStream stream(7, "test", {0});
  Order expected;
  for (int repetition = 0; repetition < 3; ++repetition) {
    std::vector<double> values = stimuli(5);
    stream.shuffle(values);  // Orders were drawn so before there were rules.
    for (const double value : values) expected.push_back(static_cast<std::size_t>(value - 10));
  }
  EXPECT_EQ(order_of({}, 5, 3), expected);
}

TEST(StimulusOrder, KeepsTheDistanceWithinRepetitionsAndAcrossTheirBoundary) {
  for (std::size_t num = 1; num <= 6; ++num) {
    for (int distance = 1; distance <= static_cast<int>(num); ++distance) {
      for (int draw = 0; draw < 20; ++draw) {
        const Order order = order_of({.min_distance = distance}, num, 4, draw);
        EXPECT_GE(least_distance(order), static_cast<std::size_t>(distance));
        for (std::size_t repetition = 0; repetition < 4; ++repetition) {
          EXPECT_TRUE(holds_every_stimulus_once(order, repetition * num, num));
        }
      }
    }
  }
}

TEST(StimulusOrder, MakesEveryOrderThatKeepsTheDistanceEquallyLikely) {
  // Three stimuli come twice, at a distance of two. There are 6 first repetitions, and of the 6
  // second ones, the 4 that do not begin with the last stimulus.
  std::map<Order, int> counts;
  constexpr int kDraws = 24000;
  for (int draw = 0; draw < kDraws; ++draw) {
    ++counts[order_of({.min_distance = 2}, 3, 2, draw)];
  }
  EXPECT_EQ(counts.size(), 24u);
  EXPECT_LT(unevenness(counts, kDraws), 1.8);
}

TEST(StimulusOrder, OneInARowIsADistanceOfTwo) {
  EXPECT_EQ(order_of({.max_in_a_row = 1}, 4, 5), order_of({.min_distance = 2}, 4, 5));
}

TEST(StimulusOrder, OfMixedRepetitionsHasNoMoreInARowThanAllowed) {
  bool has_two = false;
  for (int draw = 0; draw < 100; ++draw) {
    const Order order = order_of({.method = Method::kMixed, .max_in_a_row = 2}, 3, 6, draw);
    for (std::size_t i = 2; i < order.size(); ++i) {
      EXPECT_FALSE(order[i] == order[i - 1] && order[i] == order[i - 2]);
      has_two |= order[i] == order[i - 1];
    }
    for (std::size_t stimulus = 0; stimulus < 3; ++stimulus) {
      EXPECT_EQ(std::count(order.begin(), order.end(), stimulus), 6);
    }
  }
  EXPECT_TRUE(has_two) << "two in a row are allowed";
}

TEST(StimulusOrder, BeginsWithNoneOfThoseThatAreNotFirst) {
  for (const Method method : {Method::kShuffled, Method::kMixed}) {
    std::map<Order, int> firsts;
    for (int draw = 0; draw < 4000; ++draw) {
      const StimulusOrder rule = {.method = method, .not_first = {10.0, 12.0}};
      ++firsts[{order_of(rule, 4, 2, draw).front()}];
    }
    EXPECT_EQ(firsts.size(), 2u);
    EXPECT_FALSE(firsts.contains({0}) || firsts.contains({2}));
    EXPECT_LT(unevenness(firsts, 4000), 7.0);
  }
}

TEST(StimulusOrder, OfASquareIsRowAfterRowFromTheParticipantsOwn) {
  EXPECT_EQ(order_of({.method = Method::kLatin, .row = 2}, 3, 2), (Order{2, 0, 1, 0, 1, 2}));
  EXPECT_EQ(order_of({.method = Method::kWilliams, .row = 1}, 4, 1), (Order{1, 2, 0, 3}));
  EXPECT_EQ(num_square_rows({.method = Method::kLatin}, 5), 5u);
  EXPECT_EQ(num_square_rows({.method = Method::kWilliams}, 5), 10u);
  EXPECT_EQ(num_square_rows({.method = Method::kMixed}, 5), 0u);
}

TEST(StimulusOrder, IsFoundForEveryRuleThatTheReaderAllows) {
  for (const std::size_t num : std::vector<std::size_t>{2, 3, 8, 40, 200}) {
    const auto num_repetitions = static_cast<int>(2000 / num);
    for (const std::size_t distance : {std::size_t{1}, num / 2, num - 1, num}) {
      const StimulusOrder rule = {
          .max_in_a_row = 1, .min_distance = static_cast<int>(distance), .not_first = {10.0}};
      const Order order = order_of(rule, num, num_repetitions);
      EXPECT_GE(least_distance(order), std::max(distance, std::size_t{2})) << num;
      EXPECT_NE(order.front(), 0u);
    }
    const Order mixed =
        order_of({.method = Method::kMixed, .max_in_a_row = 1, .not_first = {10.0}}, num,
                 num_repetitions);
    EXPECT_GE(least_distance(mixed), 2u) << num;
    EXPECT_NE(mixed.front(), 0u);
  }
}

TEST(StimulusOrder, RefusesWhatNoOrderCanKeepTo) {
  EXPECT_THROW((void)order_of({.min_distance = 4}, 3, 2), core::Error);
  EXPECT_NO_THROW((void)order_of({.min_distance = 4}, 3, 1)) << "none comes again";
  EXPECT_THROW((void)order_of({.max_in_a_row = 2}, 1, 3), core::Error);
  EXPECT_THROW((void)order_of({.not_first = {10.0, 11.0}}, 2, 1), core::Error);
  EXPECT_THROW((void)order_of({.method = Method::kMixed, .max_in_a_row = 2}, 1, 3),
               core::Error);
}

}  // namespace stimulus_order_test
}  // namespace jnd::experiments
