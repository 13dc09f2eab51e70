#include "core/controls/input_events.h"

#include <gtest/gtest.h>
#include <linux/input.h>

#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "core/controls/piped_device.h"

namespace jnd::core {
namespace input_events_test {

/// Returns the events that result, in words: "+KEY_B", "-KEY_B".
std::string told(InputEvents& events, const std::vector<input_event>& written) {
  std::string words;
  for (const ControlEvent& event : events.take(std::as_bytes(std::span(written)))) {
    words += (words.empty() ? "" : " ") + std::string(event.is_down ? "+" : "-") +
             event.control.name;
  }
  return words;
}

input_event one(unsigned type, unsigned code, int value) {
  return test_event(type, code, value, 1'000'000'000);
}

TEST(InputEvents, TellsPressesWithTheKernelsTime) {
  InputEvents events("a pedal");
  const std::vector<input_event> written = {test_event(EV_MSC, MSC_SCAN, 458757, 5'000'123'000),
                                            test_event(EV_KEY, KEY_B, 1, 5'000'123'000),
                                            test_event(EV_SYN, SYN_REPORT, 0, 5'000'123'000),
                                            test_event(EV_KEY, KEY_B, 0, 5'100'456'000)};
  const auto told = events.take(std::as_bytes(std::span(written)));
  ASSERT_EQ(told.size(), 2U);
  EXPECT_EQ(told[0].control, (Control{"a pedal", "KEY_B"}));
  EXPECT_TRUE(told[0].is_down);
  EXPECT_EQ(told[0].monotonic_ns, 5'000'123'000);
  EXPECT_FALSE(told[1].is_down);
  EXPECT_EQ(told[1].monotonic_ns, 5'100'456'000);
}

// A held key repeats, which is no press. A pedal that bounces within its own report is reported
// as it is.
TEST(InputEvents, ARepeatIsNoPress) {
  InputEvents events("a pedal");
  EXPECT_EQ(told(events, {one(EV_KEY, KEY_B, 1), one(EV_KEY, KEY_B, 2), one(EV_KEY, KEY_B, 2),
                          one(EV_KEY, KEY_B, 0)}),
            "+KEY_B -KEY_B");
  EXPECT_EQ(told(events, {one(EV_KEY, KEY_B, 0)}), "") << "it was not down";
}

TEST(InputEvents, AHatIsFourButtonsAndAStickNone) {
  InputEvents events("a pad");
  EXPECT_EQ(told(events, {one(EV_ABS, ABS_HAT0X, -1), one(EV_ABS, ABS_HAT0X, 1),
                          one(EV_ABS, ABS_HAT0X, 0), one(EV_ABS, ABS_HAT0Y, 1),
                          one(EV_ABS, ABS_X, 1200), one(EV_KEY, BTN_SOUTH, 1)}),
            "+ABS_HAT0X- -ABS_HAT0X- +ABS_HAT0X+ -ABS_HAT0X+ +ABS_HAT0Y+ +BTN_SOUTH");
}

TEST(InputEvents, AnEventThatComesInPiecesIsOne) {
  InputEvents events("a pedal");
  const input_event whole = one(EV_KEY, KEY_KP1, 1);
  const auto bytes = std::as_bytes(std::span(&whole, 1));
  std::size_t num_told = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    num_told += events.take(bytes.subspan(i, 1)).size();
    EXPECT_EQ(num_told, i + 1 == bytes.size() ? 1U : 0U);
  }
  EXPECT_TRUE(events.any_down());
}

// Nobody knows what was released meanwhile, so a key that is held counts as released.
TEST(InputEvents, WhatWasDownIsLetGoWhereTheKernelDroppedEvents) {
  InputEvents events("a pedal");
  EXPECT_EQ(
      told(events, {one(EV_KEY, KEY_A, 1), one(EV_SYN, SYN_DROPPED, 0), one(EV_KEY, KEY_B, 1),
                    one(EV_SYN, SYN_REPORT, 0), one(EV_KEY, KEY_C, 1)}),
      "+KEY_A -KEY_A +KEY_C");
}

TEST(InputEvents, WhatWasDownBeforeIsToldWhenItComesUp) {
  InputEvents events("a pedal");
  events.note_down("KEY_A");
  EXPECT_TRUE(events.any_down());
  EXPECT_EQ(told(events, {one(EV_KEY, KEY_A, 0)}), "-KEY_A");
  EXPECT_FALSE(events.any_down());
}

TEST(InputEvents, ACodeWithoutANameHasItsNumber) {
  InputEvents events("a box");
  EXPECT_EQ(told(events, {one(EV_KEY, KEY_MAX, 1)}), "+KEY_MAX");
  EXPECT_EQ(told(events, {one(EV_KEY, 0x2f0, 1)}), "+KEY_752");
}

}  // namespace input_events_test
}  // namespace jnd::core
