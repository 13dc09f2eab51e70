#include "experiments/session/order_statistics.h"

#include <gtest/gtest.h>

#include <utility>

namespace jnd::experiments {
namespace order_statistics_test {

class OrderStatisticsTest : public ::testing::Test {
 protected:
  OrderStatisticsTest() {
    stage_.name = "estimation";
    stage_.content = Block{.procedure = "magnitude_estimation",
                           .quantity = "scale",
                           .intensities = {4.0, 1.0, 2.0},
                           .repetitions = 2};
  }
  /// Returns one participant's two repetitions.
  [[nodiscard]] ParticipantPlan plan(const std::vector<double>& order) const {
    PlannedBlock block{.stage = &stage_, .num_trials = 6};
    for (std::size_t i = 0; i < order.size(); ++i) {
      block.trials.push_back({.repetition = static_cast<int>(i / 3) + 1,
                              .position = static_cast<int>(i % 3) + 1,
                              .intensity = order[i]});
    }
    ParticipantPlan plan;
    plan.blocks = {block};
    return plan;
  }
  Stage stage_;
};

TEST_F(OrderStatisticsTest, CountPlacesAndFollowersByHand) {
  const auto all = order_statistics({plan({1, 2, 4, 4, 2, 1}), plan({2, 1, 4, 1, 2, 4})});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].block, "estimation");
  EXPECT_EQ(all[0].quantity, "scale");
  EXPECT_EQ(all[0].stimuli, (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(all[0].at_place, (std::vector<std::vector<int>>{{2, 1, 1}, {1, 3, 0}, {1, 0, 3}}));
  // These counts say how often 1, 2 and 4 come after 1, 2 and 4.
  EXPECT_EQ(all[0].followed_by,
            (std::vector<std::vector<int>>{{0, 2, 1}, {2, 0, 2}, {1, 1, 1}}));
  EXPECT_EQ(places_range(all[0]).fewest, 0);
  EXPECT_EQ(places_range(all[0]).most, 3);
  EXPECT_EQ(followers_range(all[0]).fewest, 1);
  EXPECT_EQ(followers_range(all[0]).most, 2);
  EXPECT_EQ(repeats_range(all[0]).fewest, 0);
  EXPECT_EQ(repeats_range(all[0]).most, 1);
}

TEST_F(OrderStatisticsTest, OfMatchesCountTheStandards) {
  stage_.content = Block{.procedure = "matching",
                         .medium = "viscous",
                         .quantity = "viscosity_pa_s",
                         .intensities = {0.5},
                         .standard_medium = "water",
                         .standards = {4.0, 1.0, 2.0},
                         .repetitions = 2};
  ParticipantPlan matches = plan({1, 2, 4, 4, 2, 1});
  for (PlannedTrial& trial : matches.blocks[0].trials) {
    trial.reference_intensity = std::exchange(trial.intensity, std::nullopt);
    trial.starting_intensity = 0.5;
  }
  const auto all = order_statistics({matches});
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].quantity, "scale");
  EXPECT_EQ(all[0].stimuli, (std::vector<double>{1, 2, 4}));
  EXPECT_EQ(all[0].at_place, (std::vector<std::vector<int>>{{1, 0, 1}, {0, 2, 0}, {1, 0, 1}}));
}

TEST_F(OrderStatisticsTest, LeaveOutWhatIsDrawnAnswerByAnswer) {
  EXPECT_TRUE(order_statistics({plan({1})}).empty());
}

TEST_F(OrderStatisticsTest, TrialsWithoutAStimulusPartTheirNeighbours) {
  ParticipantPlan with_catch = plan({1, 2, 4, 4, 2, 1});
  PlannedTrial& third = with_catch.blocks[0].trials[2];
  third.intensity.reset();
  third.is_catch = true;
  const auto all = order_statistics({with_catch});
  EXPECT_EQ(all[0].followed_by,
            (std::vector<std::vector<int>>{{0, 1, 0}, {1, 0, 0}, {0, 1, 0}}));
}

}  // namespace order_statistics_test
}  // namespace jnd::experiments
