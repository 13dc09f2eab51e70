#include "experiments/order/mixed_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "core/error.h"

namespace jnd::experiments {
namespace mixed_order_test {

using Labels = std::vector<std::string>;

constexpr ShuffleEffort kRejectOnly = {.max_shuffles = 100'000};
constexpr ShuffleEffort kCountOnly = {.max_shuffles = 0, .max_states = 1'000'000};
constexpr ShuffleEffort kSearchOnly = {.max_shuffles = 0, .max_states = 0};

/// The labels of the items: "aab" is three items, labelled "a", "a" and "b".
Labels labels_of(const std::string& letters) {
  Labels labels;
  for (const char letter : letters) labels.emplace_back(1, letter);
  return labels;
}

/// Returns each of `num_labels` labels `times` times.
Labels repeated(int num_labels, int times) {
  Labels labels;
  for (int i = 0; i < num_labels * times; ++i) labels.push_back(std::to_string(i % num_labels));
  return labels;
}

Labels in_order(const Labels& labels, const ConstrainedOrder& order) {
  Labels ordered;
  for (const std::size_t item : order.order) ordered.push_back(labels.at(item));
  return ordered;
}

ConstrainedOrder shuffled(const Labels& labels, const OrderConstraints& constraints, int seed,
                          const ShuffleEffort& effort = {}) {
  core::RandomStream stream(seed, "constrained_shuffle_test");
  return mixed_order(labels, constraints, stream, effort);
}

/// Every order of the labels that meets the constraints, found by trying all.
std::set<Labels> all_that_meet(Labels labels, const OrderConstraints& constraints) {
  std::sort(labels.begin(), labels.end());
  std::set<Labels> found;
  do {
    if (meets(labels, constraints)) found.insert(labels);
  } while (std::next_permutation(labels.begin(), labels.end()));
  return found;
}

std::string error_of(const Labels& labels, const OrderConstraints& constraints,
                     const ShuffleEffort& effort = {}) {
  try {
    static_cast<void>(shuffled(labels, constraints, 1, effort));
  } catch (const core::Error& error) {
    return error.what();
  }
  return "";
}

TEST(OrderConstraints, AreMetAsTheirFieldsSay) {
  EXPECT_TRUE(meets(labels_of("aabba"), {.max_in_a_row = 2}));
  EXPECT_FALSE(meets(labels_of("abbba"), {.max_in_a_row = 2}));
  EXPECT_FALSE(meets(labels_of("aa"), {.max_in_a_row = 1}));
  EXPECT_TRUE(meets(labels_of("aa"), {}));
  EXPECT_TRUE(meets(labels_of("abcab"), {.min_distance = 3}));
  EXPECT_FALSE(meets(labels_of("abcaca"), {.min_distance = 3}));
  EXPECT_FALSE(meets(labels_of("abccab"), {.min_distance = 2}));
  EXPECT_FALSE(meets(labels_of("abc"), {.not_first = {"c", "a"}}));
  EXPECT_TRUE(meets(labels_of("bac"), {.not_first = {"c", "a"}}));
  EXPECT_TRUE(meets({}, {.max_in_a_row = 1, .min_distance = 2}));
}

TEST(MixedOrder, MeetsItsConstraintsByEveryMethod) {
  const Labels labels = repeated(5, 4);
  const OrderConstraints several[] = {{.max_in_a_row = 2, .not_first = {"0"}},
                                      {.max_in_a_row = 1},
                                      {.min_distance = 2, .not_first = {"1", "3"}},
                                      {.min_distance = 3},
                                      {.max_in_a_row = 3, .min_distance = 4}};
  for (const OrderConstraints& constraints : several) {
    for (const ShuffleEffort& effort : {ShuffleEffort{}, kCountOnly, kSearchOnly}) {
      for (int seed = 0; seed < 100; ++seed) {
        const auto order = shuffled(labels, constraints, seed, effort);
        EXPECT_TRUE(meets(in_order(labels, order), constraints)) << seed;
        const std::set<std::size_t> items(order.order.begin(), order.order.end());
        EXPECT_EQ(items.size(), labels.size());
      }
    }
  }
}

TEST(MixedOrder, SaysByWhichMethodAnOrderWasFound) {
  const Labels labels = repeated(5, 4);
  EXPECT_EQ(shuffled(labels, {}, 1).method, OrderMethod::kRejection);
  EXPECT_EQ(shuffled(labels, {.min_distance = 4}, 1).method, OrderMethod::kCounting);
  const auto searched = shuffled(labels, {.min_distance = 4}, 1, kSearchOnly);
  EXPECT_EQ(searched.method, OrderMethod::kSearch);
  EXPECT_FALSE(searched.is_uniform());
  EXPECT_TRUE(shuffled(labels, {.min_distance = 4}, 1).is_uniform());
}

TEST(MixedOrder, CountsTheStudiesOfTheField) {
  // 8 stimuli of 5, 40 stimuli of 2 and two conditions of 100 are all uniform; none needs a
  // search.
  EXPECT_TRUE(shuffled(repeated(8, 5), {.min_distance = 3}, 1).is_uniform());
  EXPECT_TRUE(shuffled(repeated(8, 5), {.min_distance = 6}, 1).is_uniform());
  EXPECT_TRUE(shuffled(repeated(40, 2), {.min_distance = 4}, 1).is_uniform());
  EXPECT_TRUE(shuffled(repeated(2, 100), {.max_in_a_row = 3}, 1).is_uniform());
  EXPECT_TRUE(shuffled(repeated(2, 900), {.max_in_a_row = 1}, 1).is_uniform());
}

/// Returns chi-square of the counts of all orders against equal counts.
double chi_square(const Labels& labels, const OrderConstraints& constraints,
                  const ShuffleEffort& effort, int num_draws) {
  std::map<Labels, int> drawn;
  for (const Labels& order : all_that_meet(labels, constraints)) drawn[order] = 0;
  const std::size_t num_orders = drawn.size();
  core::RandomStream stream(3, "chi_square");
  for (int i = 0; i < num_draws; ++i) {
    const auto order = mixed_order(labels, constraints, stream, effort);
    ++drawn[in_order(labels, order)];
  }
  EXPECT_EQ(drawn.size(), num_orders);
  const double expected = static_cast<double>(num_draws) / static_cast<double>(num_orders);
  double sum = 0.0;
  for (const auto& [order, count] : drawn) sum += (count - expected) * (count - expected);
  return sum / expected;
}

TEST(MixedOrder, IsUniformByRejectionAndByCounting) {
  for (const ShuffleEffort& effort : {kRejectOnly, kCountOnly}) {
    // 38 orders have 37 degrees of freedom, for which the 99.9th percentile is 69.3.
    EXPECT_EQ(all_that_meet(labels_of("aaabbcc"), {.max_in_a_row = 1}).size(), 38u);
    EXPECT_LT(chi_square(labels_of("aaabbcc"), {.max_in_a_row = 1}, effort, 19'000), 69.3);
    // The percentile is 37.7 for 15 degrees of freedom and 22.5 for 6. Another program counted
    // the orders.
    const OrderConstraints apart = {.min_distance = 3, .not_first = {"b"}};
    EXPECT_EQ(all_that_meet(labels_of("aabbcd"), apart).size(), 16u);
    EXPECT_LT(chi_square(labels_of("aabbcd"), apart, effort, 8'000), 37.7);
    const OrderConstraints rows = {.max_in_a_row = 2, .not_first = {"b"}};
    EXPECT_EQ(all_that_meet(labels_of("aaabbb"), rows).size(), 7u);
    EXPECT_LT(chi_square(labels_of("aaabbb"), rows, effort, 7'000), 22.5);
  }
}

TEST(MixedOrder, DrawsTheItemsOfALabelInAnyOrder) {
  const Labels labels = labels_of("aaab");
  for (const ShuffleEffort& effort : {kRejectOnly, kCountOnly, kSearchOnly}) {
    std::set<std::vector<std::size_t>> seen;
    for (int seed = 0; seed < 300; ++seed) {
      seen.insert(shuffled(labels, {.max_in_a_row = 2}, seed, effort).order);
    }
    EXPECT_EQ(seen.size(), 12u);  // "aaba" and "abaa", in 3! orders each.
  }
}

TEST(MixedOrder, FindsAnOrderExactlyWhenThereIsOne) {
  core::RandomStream stream(9, "problems");
  int num_feasible = 0;
  constexpr int kNumProblems = 300;
  for (int i = 0; i < kNumProblems; ++i) {
    std::string letters(3 + stream.below(5), ' ');
    for (char& letter : letters) letter = static_cast<char>('a' + stream.below(4));
    OrderConstraints constraints{.min_distance = 1 + static_cast<int>(stream.below(4))};
    if (stream.below(2) == 0) constraints.max_in_a_row = 1 + static_cast<int>(stream.below(2));
    if (stream.below(2) == 0) constraints.not_first = {letters.substr(0, 1)};
    const Labels labels = labels_of(letters);
    const bool feasible = !all_that_meet(labels, constraints).empty();
    num_feasible += feasible;
    for (const ShuffleEffort& effort : {ShuffleEffort{}, kCountOnly, kSearchOnly}) {
      const std::string error = error_of(labels, constraints, effort);
      EXPECT_EQ(error.empty(), feasible) << letters << ' ' << error;
    }
  }
  EXPECT_GT(num_feasible, 50);
  EXPECT_LT(num_feasible, kNumProblems - 50);
}

TEST(MixedOrder, SaysWhyNoOrderCanMeetItsConstraints) {
  EXPECT_EQ(error_of(labels_of("aaaab"), {.max_in_a_row = 1}),
            "order.max_in_a_row: expected 3 items or more between those of `a`, which stands 4 "
            "times, 1 in a row at most, found 1; no order can meet this");
  EXPECT_EQ(error_of(labels_of("aabbc"), {.min_distance = 4}),
            "order.min_distance: expected 6 items or more for `a`, which stands 2 times as "
            "others do, at distance 4, found 5; no order can meet this");
  EXPECT_EQ(error_of(labels_of("ab"), {.not_first = {"a", "b"}}),
            "order.not_first: expected a label that may be first, found none");
  EXPECT_EQ(error_of(labels_of("ab"), {.not_first = {"c"}}),
            "order.not_first: expected one of the labels, found `c`");
  // "aba" is the only order and may not begin with a, as counting all orders shows.
  EXPECT_EQ(error_of(labels_of("aab"), {.max_in_a_row = 1, .not_first = {"a"}}),
            "order: expected constraints that some order of the 3 items meets, found that none "
            "of all orders does; loosen them");
  EXPECT_THAT(error_of(repeated(8, 5), {.min_distance = 4},
                       {.max_shuffles = 0, .max_states = 0, .max_steps = 20}),
              testing::HasSubstr("found none in 20 steps of search"));
  EXPECT_THAT(error_of(labels_of("ab"), {.max_in_a_row = 0}), testing::HasSubstr("1 or more"));
  EXPECT_THAT(error_of(labels_of("ab"), {.min_distance = 0}), testing::HasSubstr("1 or more"));
}

TEST(MixedOrder, StaysAsItIsForAFixedSeed) {
  // A study's orders must not change with the program: these were drawn when the test was
  // written.
  const Labels labels = labels_of("aabbccd");
  const OrderConstraints constraints = {.min_distance = 2, .not_first = {"d"}};
  const auto letters = [&](const ShuffleEffort& effort) {
    std::string text;
    for (const std::string& label :
         in_order(labels, shuffled(labels, constraints, 1, effort))) {
      text += label;
    }
    return text;
  };
  EXPECT_EQ(letters({}), "bacadcb");
  EXPECT_EQ(letters(kCountOnly), "cdbacba");
  EXPECT_EQ(letters(kSearchOnly), "cadbabc");
}

TEST(MixedOrder, OrdersNoItemsAndOne) {
  EXPECT_TRUE(shuffled({}, {.max_in_a_row = 1, .min_distance = 3}, 1).order.empty());
  EXPECT_EQ(shuffled({"a"}, {.max_in_a_row = 1, .min_distance = 3}, 1, kCountOnly).order,
            (std::vector<std::size_t>{0}));
}

}  // namespace mixed_order_test
}  // namespace jnd::experiments
