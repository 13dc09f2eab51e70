#include "experiments/procedures/adjustment.h"

#include <gtest/gtest.h>

#include <string>

namespace jnd::experiments {
namespace adjustment_test {

Block block_of_steps(double fine_step) {
  Block block;
  block.fine_step = fine_step;
  block.coarse_step = 5.0 * fine_step;
  return block;
}

TEST(Adjustment, ArrivesAtTheDecimalNumberThatIsMeant) {
  const Block block = block_of_steps(0.1);
  double set = 28.0;
  for (int step = 0; step < 194; ++step) set = stepped_intensity(block, 28.0, set, -0.1);
  EXPECT_EQ(set, 8.6) << "not 8.599999999999998";
  set = 0.0;
  for (int step = 0; step < 3; ++step) set = stepped_intensity(block, 0.0, set, 0.1);
  EXPECT_EQ(set, 0.3) << "not 0.30000000000000004";
}

TEST(Adjustment, AStartBetweenTwoStepsStaysBetween) {
  const Block block = block_of_steps(0.1);
  EXPECT_EQ(stepped_intensity(block, 0.123456789, 0.123456789, 0.1), 0.223456789);
  EXPECT_EQ(stepped_intensity(block, 0.123456789, 0.223456789, -0.1), 0.123456789);
}

TEST(Adjustment, StopsAtNothingAndAtTheEndOfTheBlock) {
  Block block = block_of_steps(0.25);
  EXPECT_EQ(stepped_intensity(block, 0.5, 0.25, -1.25), 0.0);
  block.max_intensity = 2.6;
  EXPECT_EQ(stepped_intensity(block, 0.5, 2.5, 1.25), 2.6);
  EXPECT_EQ(stepped_intensity(block, 0.5, 2.6, -0.25), 2.25) << "back on the steps";
}

TEST(Adjustment, OfAMatchEndsAboveNothing) {
  Block block = block_of_steps(0.1);
  block.procedure = "matching";
  EXPECT_EQ(stepped_intensity(block, 4.0, 0.3, -0.5), 0.1);
  EXPECT_EQ(stepped_intensity(block, 4.0, 0.1, -0.1), 0.1);
  EXPECT_EQ(stepped_intensity(block, 0.05, 0.05, -0.5), 0.05) << "no step down leads up";
  EXPECT_EQ(stepped_intensity(block, 0.05, 0.05, 0.1), 0.15);
}

TEST(Adjustment, NumbersWithoutRoomForMoreDigitsAreLeftAlone) {
  EXPECT_EQ(as_meant(1234567.0000001, 1e-6), 1234567.0000001);
  EXPECT_EQ(as_meant(8.599999999999998, 0.1), 8.6);
  EXPECT_EQ(as_meant(0.1 + 0.2, 1e-3), 0.3);
}

}  // namespace adjustment_test
}  // namespace jnd::experiments
