#include "analysis/statistics/sequential_test.h"

#include <gtest/gtest.h>

#include "core/random_stream.h"

namespace jnd::analysis {
namespace sequential_test_test {

SequentialBoundaries two_looks(Tail tail = Tail::kTwoSided) {
  return boundaries_of({.looks = {12, 24}, .tail = tail});
}

/// Returns an estimate with 11 degrees of freedom.
EffectEstimate with_t(double t) { return {t * 0.1, 0.1, 11.0}; }

TEST(SequentialTest, HasNominalLevelsOfItsBoundaries) {
  // z = 2.9626 and 1.9686 (Lan and DeMets 1983, two equal looks).
  const SequentialBoundaries found = two_looks();
  ASSERT_EQ(found.nominal_level.size(), 2U);
  EXPECT_NEAR(found.nominal_level[0], 0.00305, 1e-5);
  EXPECT_NEAR(found.nominal_level[1], 0.04900, 1e-5);
  EXPECT_NEAR(boundaries_of({.looks = {20}, .alpha = 0.01}).nominal_level[0], 0.01, 1e-9);
}

TEST(SequentialTest, ComparesThePValueOfTWithTheNominalLevel) {
  // t with 11 degrees of freedom has p = 0.00305 at 3.76, which is far beyond z = 2.96.
  EXPECT_FALSE(crosses(two_looks(), 0, with_t(3.70)));
  EXPECT_TRUE(crosses(two_looks(), 0, with_t(3.82)));
  EXPECT_TRUE(crosses(two_looks(), 0, with_t(-3.82)));
  EXPECT_FALSE(crosses(two_looks(Tail::kGreater), 0, with_t(-3.82))) << "the wrong side";
  EXPECT_TRUE(crosses(two_looks(Tail::kLess), 0, with_t(-3.82)));
  EXPECT_FALSE(crosses(two_looks(), 0, std::nullopt));
}

TEST(SequentialTest, EndsAtTheFirstLookThatCrossesOrAtTheLast) {
  const SequentialOutcome first = sequential_outcome(two_looks(), {with_t(5.0), with_t(0.1)});
  EXPECT_TRUE(first.ended && first.significant);
  EXPECT_EQ(first.estimates.size(), 1U) << "what came later is dropped";
  const SequentialOutcome second = sequential_outcome(two_looks(), {with_t(1.0), with_t(2.3)});
  EXPECT_TRUE(second.ended && second.significant);
  const SequentialOutcome none = sequential_outcome(two_looks(), {with_t(1.0), with_t(1.0)});
  EXPECT_TRUE(none.ended);
  EXPECT_FALSE(none.significant);
  const SequentialOutcome open = sequential_outcome(two_looks(), {with_t(1.0)});
  EXPECT_FALSE(open.ended || open.significant);
  EXPECT_FALSE(sequential_outcome(two_looks(), {}).ended);
}

TEST(SequentialTest, TakesTheFirstPeopleByGroup) {
  const std::vector<std::optional<PersonScore>> people = {
      PersonScore{0, 1.0}, PersonScore{1, 0.0}, std::nullopt,
      PersonScore{0, 3.0}, PersonScore{1, 1.0}, PersonScore{0, 99.0}};
  const auto found = estimate_of_first(people, 5, 2);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->effect, 2.0 + 0.5, 1e-12) << "the sum over both groups of their means";
  EXPECT_FALSE(estimate_of_first(people, 4, 2)) << "one person in a group tells no spread";
}

// The test keeps its level also with few people. In 10,000 studies without an effect, the
// standard error of 5 % is 0.22 %.
TEST(SequentialTest, FindsWhatIsNotThereInAtMostFivePercent) {
  for (const auto spending : {SpendingFunction::kObrienFleming, SpendingFunction::kPocock}) {
    const SequentialBoundaries boundaries =
        boundaries_of({.looks = {8, 12, 16, 20}, .spending = spending});
    core::RandomStream random(7, "studies without an effect");
    constexpr int kStudies = 10000;
    int num_significant = 0;
    for (int study = 0; study < kStudies; ++study) {
      std::vector<std::optional<PersonScore>> people;
      for (int person = 0; person < 20; ++person) {
        people.push_back(PersonScore{0, random.normal()});
      }
      std::vector<std::optional<EffectEstimate>> estimates;
      for (const int look : boundaries.rule.looks) {
        estimates.push_back(estimate_of_first(people, static_cast<std::size_t>(look), 1));
      }
      num_significant += sequential_outcome(boundaries, estimates).significant ? 1 : 0;
    }
    EXPECT_NEAR(num_significant, 0.05 * kStudies, 3.0 * 0.0022 * kStudies);
  }
}

}  // namespace sequential_test_test
}  // namespace jnd::analysis
