#include "device/plugin/shared_slot.h"

#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cstring>
#include <thread>

namespace jnd::device {
namespace shared_slot_test {

struct Value {
  std::array<std::uint64_t, 40> all{};
};

Value of(std::uint64_t number) {
  Value value;
  value.all.fill(number);
  return value;
}

TEST(SharedSlot, HasNothingBeforeTheFirst) {
  const SharedSlot<Value> slot;
  Value value;
  EXPECT_FALSE(slot.load(value));
}

TEST(SharedSlot, GivesTheNewestAndWholeValuesAlone) {
  SharedSlot<Value> slot;
  std::atomic<bool> is_over{false};
  std::thread writer([&] {
    for (std::uint64_t i = 1; !is_over; ++i) slot.store(of(i));
  });
  std::uint64_t last = 0;
  bool are_whole = true, rise = true;
  for (int i = 0; i < 200'000; ++i) {
    Value value;
    if (!slot.load(value)) continue;
    for (const std::uint64_t one : value.all) are_whole &= one == value.all.front();
    rise &= value.all.front() >= last;
    last = value.all.front();
  }
  is_over = true;
  writer.join();
  EXPECT_TRUE(are_whole);
  EXPECT_TRUE(rise);
  Value value;
  EXPECT_TRUE(slot.load(value));
}

/// A process that dies in the middle of a value leaves an odd version for ever.
TEST(SharedSlot, NobodyWaitsForAWriterThatDiedInTheMiddle) {
  SharedSlot<Value> slot;
  slot.store(of(1));
  auto& version = const_cast<std::atomic<std::uint32_t>&>(slot.version());
  version = version + 1;
  Value value;
  EXPECT_FALSE(slot.load(value));
  slot.store(of(2));
  EXPECT_TRUE(slot.load(value));
  EXPECT_EQ(value.all[7], 2U);
}

}  // namespace shared_slot_test
}  // namespace jnd::device
