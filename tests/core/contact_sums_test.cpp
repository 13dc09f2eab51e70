#include "core/contact_sums.h"

#include <gtest/gtest.h>

namespace jnd::core {
namespace {

TEST(ContactSums, TheirDifferenceIsWhatHappenedInBetween) {
  const ContactSums from{.num_ticks = 10,
                         .opposing_w = 4.0,
                         .rendered_opposing_w = 3.0,
                         .speed_squared_m2_per_s2 = 1.0};
  const ContactSums until{.num_ticks = 30,
                          .opposing_w = 10.0,
                          .rendered_opposing_w = 5.0,
                          .speed_squared_m2_per_s2 = 3.0};
  const ContactSums between = until - from;
  EXPECT_EQ(between.num_ticks, 20);
  EXPECT_DOUBLE_EQ(between.felt_damping_n_s_per_m(), 3.0);
  EXPECT_DOUBLE_EQ(between.delivered_damping_n_s_per_m(), 1.0);
}

TEST(ContactSums, AHandThatNeverMovedFeltNoDamping) {
  EXPECT_EQ(ContactSums{}.felt_damping_n_s_per_m(), 0.0);
  EXPECT_EQ(ContactSums{}.delivered_damping_n_s_per_m(), 0.0);
}

}  // namespace
}  // namespace jnd::core
