#include "analysis/planning/power_sequential.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace jnd::analysis {
namespace power_sequential_test {

PlannedSequential two_looks() {
  return {.contrast = "planned", .boundaries = boundaries_of({.looks = {4, 6}})};
}

TEST(PowerSequential, EndsARunAtItsLookAndTellsTheFixedStudiesBeside) {
  std::vector<std::optional<PersonScore>> people;
  // At four people t = 1 / 0.0577 with 3 degrees of freedom, so p = 0.0004. The level is
  // 0.0121.
  for (const double score : {1.1, 0.9, 1.1, 0.9, -9.0, 9.0}) {
    people.push_back(PersonScore{0, score});
  }
  const SequentialRun early = sequential_run(two_looks(), people, 1);
  EXPECT_EQ(early.look, 0U);
  EXPECT_TRUE(early.significant);
  EXPECT_EQ(early.fixed_significant, (std::vector<bool>{true, false, false}));
  people[0] = PersonScore{0, -3.0};
  const SequentialRun late = sequential_run(two_looks(), people, 1);
  EXPECT_EQ(late.look, 1U);
  EXPECT_FALSE(late.significant);
}

TEST(PowerSequential, CountsByHand) {
  const std::vector<SequentialRun> runs = {
      {.look = 0, .significant = true, .fixed_significant = {true, true, true}},
      {.look = 1, .significant = true, .fixed_significant = {false, true, true}},
      {.look = 1, .significant = false, .fixed_significant = {false, false, true}},
      {.look = 1, .significant = false, .fixed_significant = {false, false, false}}};
  const SequentialPower power = sequential_power(two_looks(), runs).value();
  EXPECT_EQ(power.num_ended, (std::vector<std::int64_t>{1, 3}));
  EXPECT_EQ(power.num_significant, (std::vector<std::int64_t>{1, 1}));
  EXPECT_DOUBLE_EQ(power.power, 0.5);
  // The interval is that of Wilson (1927) for 2 of 4.
  EXPECT_NEAR(power.power_low, 0.1500, 1e-4);
  EXPECT_NEAR(power.power_high, 0.8500, 1e-4);
  EXPECT_DOUBLE_EQ(power.mean_participants, 5.5);
  // The variance over four runs is 0.75.
  EXPECT_NEAR(power.standard_error, 0.433013, 1e-6);
  EXPECT_DOUBLE_EQ(power.fixed_power, 0.75);
  EXPECT_EQ(power.fixed_participants, 5) << "the first size with two of four";
}

TEST(PowerSequential, ARuleThatErrsTooOftenIsADoubt) {
  SequentialPower power{.num_runs = 1000, .power = 0.08, .power_low = 0.0648};
  EXPECT_EQ(sequential_doubt(two_looks(), power)
                .find("planned: by its looks the study finds a "
                      "difference where there is none in 8.0 % "
                      "of the runs, and at most 5.0 % were to be"),
            0U)
      << sequential_doubt(two_looks(), power);
  power.power_low = 0.049;
  EXPECT_EQ(sequential_doubt(two_looks(), power), "") << "so many runs may be 5 %";
}

TEST(PowerSequential, IsNoneWithoutLooksAndWantsRuns) {
  EXPECT_FALSE(sequential_power(std::nullopt, {}));
  EXPECT_THROW((void)sequential_power(two_looks(), {}), core::Error);
}

}  // namespace power_sequential_test
}  // namespace jnd::analysis
