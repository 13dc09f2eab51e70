#include "core/contact_sums.h"

#include <gtest/gtest.h>

namespace jnd::core {
namespace {

TEST(ContactSums, TheirDifferenceIsWhatHappenedInBetween) {
  // Two ticks between, by hand: 1.2 N at 0.1 m/s and 1.6 N at 0.3 m/s, a line 1 N + 2 N s/m v.
  const ContactSums from{.num_ticks = 10,
                         .opposing_w = 4.0,
                         .rendered_opposing_w = 3.0,
                         .speed_squared_m2_per_s2 = 1.0,
                         .speed_m_per_s = 2.0,
                         .opposing_n = 5.0};
  const ContactSums until{.num_ticks = 12,
                          .opposing_w = 4.0 + 0.12 + 0.48,
                          .rendered_opposing_w = 3.2,
                          .speed_squared_m2_per_s2 = 1.0 + 0.01 + 0.09,
                          .speed_m_per_s = 2.4,
                          .opposing_n = 7.8};
  const ContactSums between = until - from;
  EXPECT_EQ(between.num_ticks, 2);
  EXPECT_NEAR(between.felt_damping_n_s_per_m(), 2.0, 1e-9);
  EXPECT_NEAR(between.delivered_damping_n_s_per_m(), 2.0, 1e-9);  // 0.2 W over 0.1 m2/s2
}

TEST(ContactSums, AHandThatNeverMovedFeltNoDamping) {
  EXPECT_EQ(ContactSums{}.felt_damping_n_s_per_m(), 0.0);
  EXPECT_EQ(ContactSums{}.delivered_damping_n_s_per_m(), 0.0);
}

}  // namespace
}  // namespace jnd::core
