#include "app/operator/scope_channels.h"

#include <gtest/gtest.h>

#include <set>

#include "core/sample_table.h"

namespace jnd::app {
namespace scope_channels_test {

TEST(ScopeChannels, AreEveryColumnOfASampleButItsTick) {
  for (const bool with_joints : {false, true}) {
    const std::vector<std::string> columns = core::sample_column_names({.joints = with_joints});
    const std::vector<ScopeChannel> channels = scope_channels(with_joints);
    ASSERT_EQ(channels.size() + 1, columns.size());
    for (std::size_t i = 0; i < channels.size(); ++i) {
      EXPECT_EQ(channels[i].name, columns[i + 1]);
    }
  }
}

TEST(ScopeChannels, TheUnitIsWhatTheNameEndsInAndTheLabelWhatIsBeforeIt) {
  const std::vector<ScopeChannel> all = scope_channels(true);
  const auto contains = [&](const ScopeChannel& channel) {
    return std::ranges::find(all, channel) != all.end();
  };
  EXPECT_TRUE(contains({"index_force_x_n", "index force x", "N"}));
  EXPECT_TRUE(contains({"palm_inner_velocity_z_m_per_s", "palm inner velocity z", "m/s"}));
  EXPECT_TRUE(contains({"end_effector_position_y_m", "end effector position y", "m"}));
  EXPECT_TRUE(contains({"arm_7_torque_n_m", "arm 7 torque", "N m"}));
  EXPECT_TRUE(contains({"thumb_proximal_position_rad", "thumb proximal position", "rad"}));
  EXPECT_TRUE(contains({"attached_bits", "attached bits", ""}));
  std::set<std::string> units;
  for (const ScopeChannel& channel : all) units.insert(channel.unit);
  EXPECT_EQ(units, (std::set<std::string>{"", "N", "N m", "m", "m/s", "rad"}));
}

TEST(ScopeChannels, MatchWhereEveryTypedWordIsInLabelOrUnit) {
  const std::vector<ScopeChannel> all = scope_channels(true);
  EXPECT_EQ(channels_matching(all, "").size(), all.size());
  const std::vector<ScopeChannel> forces = channels_matching(all, "  Force INDEX ");
  ASSERT_EQ(forces.size(), 3U);
  EXPECT_EQ(forces[0].name, "index_force_x_n");
  EXPECT_EQ(channels_matching(all, "arm rad").size(), 7U);
  EXPECT_TRUE(channels_matching(all, "index toe").empty());
}

}  // namespace scope_channels_test
}  // namespace jnd::app
