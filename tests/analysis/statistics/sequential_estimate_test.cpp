#include "analysis/statistics/sequential_estimate.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/random_stream.h"
#include "support/sanitizer.h"

namespace jnd::analysis {
namespace sequential_estimate_test {

const EffectEstimate kFirst = {0.3, 0.28, 11.0}, kSecond = {0.5, 0.2, 23.0};

SequentialBoundaries two_looks(Tail tail = Tail::kTwoSided) {
  return boundaries_of({.looks = {12, 24}, .tail = tail});
}

SequentialEstimate estimate_of(const SequentialBoundaries& boundaries,
                               const std::vector<std::optional<EffectEstimate>>& estimates) {
  return SequentialEstimate::of(boundaries, sequential_outcome(boundaries, estimates)).value();
}

TEST(SequentialEstimate, AtTheFirstLookIsThatOfStudentsTest) {
  const EffectEstimate strong = {1.2, 0.2, 11.0};
  const SequentialEstimate found = estimate_of(two_looks(), {strong});
  const Interval expected = interval_of(strong, 0.95);
  EXPECT_NEAR(*found.interval(0.95).low, *expected.low, 1e-6);
  EXPECT_NEAR(*found.interval(0.95).high, *expected.high, 1e-6);
  EXPECT_NEAR(*found.median_unbiased(), 1.2, 1e-6);
  EXPECT_NEAR(found.p_value(), p_value_of(strong, Tail::kTwoSided), 1e-12);
}

// R 4.2.2 computes the same integrals: `integrate` over the first look, and `pt` with a
// noncentrality.
TEST(SequentialEstimate, AtTheSecondLookIsWhatRIntegrates) {
  const SequentialEstimate found = estimate_of(two_looks(), {kFirst, kSecond});
  EXPECT_NEAR(found.probability_above(0.0), 0.01078709, 2e-7);
  EXPECT_NEAR(found.p_value(), 0.02157419, 4e-7);
  EXPECT_NEAR(*found.interval(0.95).low, 0.080907, 5e-6);
  EXPECT_NEAR(*found.median_unbiased(), 0.498947, 5e-6);
  EXPECT_NEAR(*found.interval(0.95).high, 0.913420, 5e-6);
}

TEST(SequentialEstimate, IsBelowAlphaJustWhereABoundaryWasCrossed) {
  const SequentialBoundaries boundaries = two_looks();
  // The nominal level is 0.0490, at which t with 23 degrees of freedom is 2.079.
  for (const double t : {2.0, 2.07, 2.09, 2.2}) {
    const SequentialOutcome outcome =
        sequential_outcome(boundaries, {kFirst, EffectEstimate{t * 0.1, 0.1, 23.0}});
    const auto found = SequentialEstimate::of(boundaries, outcome);
    EXPECT_EQ(found->p_value() < 0.05, outcome.significant) << t;
    EXPECT_EQ(*found->interval(0.95).low > 0.0, outcome.significant) << t;
  }
}

TEST(SequentialEstimate, IsTurnedRoundWhereTheDataAre) {
  const auto turned = [](const EffectEstimate& one) {
    return EffectEstimate{-one.effect, one.standard_error, one.degrees_of_freedom};
  };
  for (const auto& [tail, other] :
       {std::pair(Tail::kTwoSided, Tail::kTwoSided), std::pair(Tail::kGreater, Tail::kLess)}) {
    const SequentialEstimate up = estimate_of(two_looks(tail), {kFirst, kSecond});
    const SequentialEstimate down =
        estimate_of(two_looks(other), {turned(kFirst), turned(kSecond)});
    EXPECT_NEAR(up.p_value(), down.p_value(), 1e-9);
    EXPECT_NEAR(*up.interval(0.95).low, -*down.interval(0.95).high, 1e-5);
    EXPECT_NEAR(*up.interval(0.95).high, -*down.interval(0.95).low, 1e-5);
    EXPECT_NEAR(up.probability_above(0.2), down.probability_below(-0.2), 1e-9);
  }
}

TEST(SequentialEstimate, IsNoneOfAStudyThatGoesOn) {
  const SequentialBoundaries boundaries = two_looks();
  EXPECT_FALSE(SequentialEstimate::of(boundaries, sequential_outcome(boundaries, {kFirst})));
  EXPECT_FALSE(SequentialEstimate::of(boundaries, {}));
}

TEST(SequentialEstimate, GrowsWithTheEffectFarOut) {
  const SequentialEstimate found =
      estimate_of(boundaries_of({.looks = {6, 12, 24}, .spending = SpendingFunction::kPocock}),
                  {EffectEstimate{0.1, 0.4, 5.0}, kFirst, kSecond});
  double last = 0.0;
  for (double effect = -20.0; effect <= 20.0; effect += 0.25) {
    const double above = found.probability_above(effect);
    EXPECT_GE(above, last - 1e-9) << effect;
    last = above;
  }
  EXPECT_NEAR(last, 1.0, 1e-9);
}

// `./dev coverage 1000 sequential` makes the table. This test takes 300 studies with a standard
// error of 1.3 %, the fewest that can tell 95 from 85 %.
TEST(SequentialEstimate, HoldsTheTruthOfStudiesThatStopEarly) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  const SequentialBoundaries boundaries =
      boundaries_of({.looks = {10, 20}, .spending = SpendingFunction::kPocock});
  core::RandomStream random(3, "studies that stop early");
  constexpr int kStudies = 300;
  constexpr double kTruth = 0.7;
  int num_held = 0, num_above = 0, num_early = 0;
  for (int study = 0; study < kStudies; ++study) {
    std::vector<std::optional<PersonScore>> people;
    for (int person = 0; person < 20; ++person) {
      people.push_back(PersonScore{0, kTruth + random.normal()});
    }
    const SequentialOutcome outcome = sequential_outcome(
        boundaries, {estimate_of_first(people, 10, 1), estimate_of_first(people, 20, 1)});
    const auto found = SequentialEstimate::of(boundaries, outcome);
    const Interval ci95 = found->interval(0.95);
    num_held += *ci95.low <= kTruth && kTruth <= *ci95.high ? 1 : 0;
    num_above += *found->median_unbiased() > kTruth ? 1 : 0;
    num_early += outcome.estimates.size() == 1 ? 1 : 0;
  }
  EXPECT_GT(num_early, 75) << "or nothing is tested";
  EXPECT_NEAR(num_held, 0.95 * kStudies, 3.0 * 0.0126 * kStudies);
  EXPECT_NEAR(num_above, 0.5 * kStudies, 3.0 * 0.0289 * kStudies);
}

}  // namespace sequential_estimate_test
}  // namespace jnd::analysis
