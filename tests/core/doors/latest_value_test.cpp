#include "core/doors/latest_value.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <thread>

#include "core/haptic_command.h"
#include "core/telemetry.h"

namespace jnd::core {
namespace {

TEST(LatestValue, StartsWithADefaultValueAndNothingNew) {
  LatestValue<HapticCommand> door;
  EXPECT_FALSE(door.fetch());
  EXPECT_EQ(door.value().sequence, 0U);
}

TEST(LatestValue, TheNewestWins) {
  LatestValue<int> door;
  for (int i = 1; i <= 7; ++i) door.publish(i);
  EXPECT_TRUE(door.fetch());
  EXPECT_EQ(door.value(), 7);
  EXPECT_FALSE(door.fetch());
  EXPECT_EQ(door.value(), 7);
  door.publish(8);
  EXPECT_EQ(door.value(), 7) << "what was fetched stays until the next fetch";
  EXPECT_TRUE(door.fetch());
  EXPECT_EQ(door.value(), 8);
}

TEST(LatestValue, AReaderNeverSeesHalfAValueNorAnOlderOne) {
  struct Wide {
    std::array<std::uint64_t, 40> copies{};
  };
  LatestValue<Wide> door;
  constexpr std::uint64_t kLast = 200'000;
  std::thread writer([&door] {
    Wide wide;
    for (std::uint64_t i = 1; i <= kLast; ++i) {
      wide.copies.fill(i);
      door.publish(wide);
    }
  });
  std::uint64_t last = 0;
  std::uint64_t torn = 0;
  std::uint64_t older = 0;
  while (last != kLast) {
    if (!door.fetch()) {
      std::this_thread::yield();
      continue;
    }
    const Wide& wide = door.value();
    for (const std::uint64_t copy : wide.copies) torn += copy != wide.copies[0] ? 1 : 0;
    older += wide.copies[0] <= last ? 1 : 0;
    last = wide.copies[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(older, 0U);
}

}  // namespace
}  // namespace jnd::core
