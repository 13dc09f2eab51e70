#include "core/exchange/latest_value.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstdint>
#include <thread>

#include "core/exchange/haptic_command.h"
#include "core/exchange/telemetry.h"

namespace jnd::core {
namespace latest_value_test {

TEST(LatestValue, StartsWithADefaultValueAndNothingNew) {
  LatestValue<HapticCommand> latest;
  EXPECT_FALSE(latest.fetch());
  EXPECT_EQ(latest.value().sequence, 0U);
}

TEST(LatestValue, TheNewestWins) {
  LatestValue<int> latest;
  for (int i = 1; i <= 7; ++i) latest.publish(i);
  EXPECT_TRUE(latest.fetch());
  EXPECT_EQ(latest.value(), 7);
  EXPECT_FALSE(latest.fetch());
  EXPECT_EQ(latest.value(), 7);
  for (int i = 8; i <= 20; ++i) {
    latest.publish(i);
    EXPECT_EQ(latest.value(), 7) << "what was fetched stays until the next fetch";
  }
  EXPECT_TRUE(latest.fetch());
  EXPECT_EQ(latest.value(), 20);
}

TEST(LatestValue, AReaderNeverSeesHalfAValueNorAnOlderOne) {
  struct Wide {
    std::array<std::uint64_t, 40> copies{};
  };
  LatestValue<Wide> latest;
  std::atomic<bool> enough{false};
  std::atomic<std::uint64_t> last_published{0};
  std::thread writer([&] {
    // This takes long enough for both threads to run at once, even on a busy machine.
    Wide wide;
    std::uint64_t i = 0;
    while (!enough && i < 3'000'000) {
      wide.copies.fill(++i);
      latest.publish(wide);
    }
    last_published = i;
  });
  std::uint64_t last = 0;
  std::uint64_t torn = 0;
  std::uint64_t num_fetched = 0;
  std::uint64_t older = 0;
  while (last_published == 0 || last != last_published) {
    if (!latest.fetch()) {
      std::this_thread::yield();
      continue;
    }
    const Wide& wide = latest.value();
    const std::uint64_t first_look = wide.copies[0];
    if (++num_fetched >= 20'000) enough = true;
    // The reader is so slow that the writer overtakes it many times while it looks, even on a
    // machine with one free core.
    std::this_thread::yield();
    for (const std::uint64_t copy : wide.copies) torn += copy != first_look ? 1 : 0;
    older += wide.copies[0] <= last ? 1 : 0;
    last = wide.copies[0];
  }
  writer.join();
  EXPECT_EQ(torn, 0U);
  EXPECT_EQ(older, 0U);
}

}  // namespace latest_value_test
}  // namespace jnd::core
