#include "core/contact_sums.h"

#include <gtest/gtest.h>

namespace jnd::core {
namespace contact_sums_test {

TEST(ContactSums, TheirDifferenceIsWhatHappenedInBetween) {
  const ContactSums from{
      .num_ticks = 10, .opposing_n = 5.0, .rendered_opposing_n = 3.0, .speed_m_per_s = 2.0};
  // Two more ticks render 0.3 N and 0.5 N at 0.1 and 0.3 m/s, and the device adds 1 N in each.
  const ContactSums until{
      .num_ticks = 12, .opposing_n = 7.8, .rendered_opposing_n = 3.8, .speed_m_per_s = 2.4};
  const ContactSums between = until - from;
  EXPECT_EQ(between.num_ticks, 2);
  EXPECT_NEAR(between.opposing_n, 2.8, 1e-12);
  EXPECT_NEAR(between.delivered_damping_n_s_per_m(), 2.0, 1e-12);  // This is 0.4 N at 0.2 m/s.
}

TEST(ContactSums, AHandThatNeverMovedWasGivenNoDamping) {
  EXPECT_EQ(ContactSums{}.delivered_damping_n_s_per_m(), 0.0);
}

}  // namespace contact_sums_test
}  // namespace jnd::core
