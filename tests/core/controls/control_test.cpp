#include "core/controls/control.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace jnd::core {
namespace control_test {

const Control kPedal{"0c45:7403 FootSwitch", "KEY_B"};
const Control kOtherPedal{"0c45:7403 FootSwitch", "KEY_C"};
const Control kPad{"046d:c21d Gamepad F310", "ABS_HAT0X-"};

TEST(Control, HasWordsForPeopleAndForTheLog) {
  EXPECT_EQ(words_of(kPedal), "FootSwitch: B");
  EXPECT_EQ(words_of(kPad), "Gamepad F310: Hat 0X-");
  EXPECT_EQ(words_of({"045e:028e Pad", "BTN_TRIGGER_HAPPY"}), "Pad: Trigger happy");
  EXPECT_EQ(words_of({"serial /dev/ttyUSB1", "byte 49"}), "serial /dev/ttyUSB1: byte 49");
  EXPECT_EQ(stored_words(kPedal), "0c45:7403 FootSwitch/KEY_B");
}

TEST(ControlMap, HasOneControlForAnActionAndOneActionForAControl) {
  ControlMap map;
  EXPECT_FALSE(map.names(kPedal.device));
  map.set("first", kPedal);
  map.set("second", kOtherPedal);
  EXPECT_EQ(map.action_of(kPedal), "first");
  EXPECT_EQ(map.action_of(kPad), "");
  ASSERT_NE(map.control_of("second"), nullptr);
  EXPECT_EQ(*map.control_of("second"), kOtherPedal);
  EXPECT_TRUE(map.names(kPedal.device));
  EXPECT_FALSE(map.names(kPad.device));
  map.set("stop", kPedal);  // The pedal no longer does what it did before.
  EXPECT_EQ(map.control_of("first"), nullptr);
  map.set("stop", kPad);
  EXPECT_EQ(map.action_of(kPedal), "");
  EXPECT_EQ(map.rows().size(), 2U);
  map.forget("stop");
  map.forget("stop");
  EXPECT_EQ(map.rows().size(), 1U);
}

TEST(ControlMap, TakesNoActionThatIsNone) {
  ControlMap map;
  EXPECT_THROW(map.set("frist", kPedal), Error);
  EXPECT_THROW(map.set("", kPedal), Error);
  EXPECT_TRUE(map.rows().empty());
  for (const std::string_view action : kControlActions) map.set(std::string(action), kPedal);
  EXPECT_EQ(map.rows().size(), 1U);
}

}  // namespace control_test
}  // namespace jnd::core
