#include "core/exchange/flight_recorder.h"

#include <gtest/gtest.h>

#include "support/allocation_counter.h"

namespace jnd::core {
namespace flight_recorder_test {

std::vector<std::int64_t> ticks_of(const FlightRecorder& recorder) {
  std::vector<std::int64_t> ticks;
  for (const Sample& sample : recorder.contents()) ticks.push_back(sample.tick);
  return ticks;
}

TEST(FlightRecorder, HoldsWhatThereIsBeforeItIsFull) {
  FlightRecorder recorder(4);
  EXPECT_TRUE(recorder.contents().empty());
  recorder.record({.tick = 1});
  recorder.record({.tick = 2});
  EXPECT_EQ(ticks_of(recorder), (std::vector<std::int64_t>{1, 2}));
}

TEST(FlightRecorder, HoldsTheLastTicksOldestFirst) {
  FlightRecorder recorder(4);
  for (std::int64_t tick = 0; tick < 11; ++tick) recorder.record({.tick = tick});
  EXPECT_EQ(ticks_of(recorder), (std::vector<std::int64_t>{7, 8, 9, 10}));
  recorder.record({.tick = 11});
  EXPECT_EQ(ticks_of(recorder), (std::vector<std::int64_t>{8, 9, 10, 11}));
}

TEST(FlightRecorder, FrozenItKeepsWhatLedToTheFault) {
  FlightRecorder recorder(2);
  recorder.record({.tick = 1});
  recorder.record({.tick = 2});
  recorder.freeze();
  EXPECT_TRUE(recorder.is_frozen());
  recorder.record({.tick = 3});
  EXPECT_EQ(ticks_of(recorder), (std::vector<std::int64_t>{1, 2}));
  recorder.thaw();
  recorder.record({.tick = 4});
  EXPECT_EQ(ticks_of(recorder), (std::vector<std::int64_t>{4}));
}

TEST(FlightRecorder, IsSafeToUseOnTheHapticThread) {
  if (!test_support::AllocationCounter::is_supported()) GTEST_SKIP();
  FlightRecorder recorder(3);
  const test_support::AllocationCounter counter;
  for (std::int64_t tick = 0; tick < 10; ++tick) recorder.record({.tick = tick});
  recorder.freeze();
  recorder.thaw();
  EXPECT_EQ(counter.allocations(), 0U);
}

}  // namespace flight_recorder_test
}  // namespace jnd::core
