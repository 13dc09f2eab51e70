#include "core/exchange/spsc_queue.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <thread>
#include <vector>

#include "support/allocation_counter.h"

namespace jnd::core {
namespace spsc_queue_test {

TEST(SpscQueue, KeepsTheOrder) {
  SpscQueue<int> queue(4);
  int value = 0;
  EXPECT_FALSE(queue.try_pop(value));
  for (int round = 0; round < 10; ++round) {
    EXPECT_TRUE(queue.try_push(2 * round));
    EXPECT_TRUE(queue.try_push(2 * round + 1));
    EXPECT_TRUE(queue.try_pop(value));
    EXPECT_EQ(value, 2 * round);
    EXPECT_TRUE(queue.try_pop(value));
    EXPECT_EQ(value, 2 * round + 1);
  }
}

TEST(SpscQueue, CountsWhatItDroppedAndKeepsWhatItHad) {
  SpscQueue<int> queue(3);
  EXPECT_EQ(queue.capacity(), 4U) << "rounded up to a power of two";
  for (int i = 0; i < 6; ++i) EXPECT_EQ(queue.try_push(i), i < 4);
  EXPECT_EQ(queue.num_dropped(), 2U);
  EXPECT_EQ(queue.num_free(), 0U);
  std::vector<int> seen;
  EXPECT_EQ(queue.drain([&seen](int value) { seen.push_back(value); }), 4U);
  EXPECT_EQ(seen, (std::vector{0, 1, 2, 3}));
  EXPECT_EQ(queue.size(), 0U);
  EXPECT_TRUE(queue.try_push(9));
}

TEST(SpscQueue, HasRoomForOneAtLeast) {
  SpscQueue<int> queue(0);
  EXPECT_TRUE(queue.try_push(1));
  EXPECT_FALSE(queue.try_push(2));
}

TEST(SpscQueue, UnderTwoThreadsEverythingArrivesOrIsCounted) {
  struct Wide {
    std::uint64_t number = 0;
    std::uint64_t copies[20] = {};
  };
  SpscQueue<Wide> queue(64);
  constexpr std::uint64_t kNumPushed = 300'000;
  std::thread writer([&queue] {
    Wide wide;
    for (std::uint64_t i = 1; i <= kNumPushed; ++i) {
      wide.number = i;
      for (std::uint64_t& copy : wide.copies) copy = i;
      (void)queue.try_push(wide);
    }
  });
  std::uint64_t num_arrived = 0;
  std::uint64_t last = 0;
  std::uint64_t wrong = 0;
  const auto visit = [&](const Wide& wide) {
    ++num_arrived;
    wrong += wide.number <= last ? 1 : 0;
    for (const std::uint64_t copy : wide.copies) wrong += copy != wide.number ? 1 : 0;
    last = wide.number;
  };
  int num_empty = 0;
  while (num_arrived + queue.num_dropped() < kNumPushed) {
    // The reader takes a new value at once, but finally leaves a single core to the writer.
    num_empty = queue.drain(visit) == 0 ? num_empty + 1 : 0;
    if (num_empty > 1000) std::this_thread::yield();
  }
  writer.join();
  queue.drain(visit);
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(num_arrived + queue.num_dropped(), kNumPushed);
}

TEST(SpscQueue, IsSafeToUseOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  SpscQueue<int> queue(8);
  const test_support::AllocationCounter counter;
  for (int i = 0; i < 20; ++i) (void)queue.try_push(i);
  EXPECT_EQ(counter.allocations(), 0U);
}

}  // namespace spsc_queue_test
}  // namespace jnd::core
