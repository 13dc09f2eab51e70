#include "app/gui/views/typed_number.h"

#include <gtest/gtest.h>

namespace jnd::app::gui {
namespace typed_number_test {

TEST(TypedNumber, IsWhatPeopleWrite) {
  EXPECT_EQ(typed_number("41"), 41.0);
  EXPECT_EQ(typed_number("1.85"), 1.85);
  EXPECT_EQ(typed_number("-3"), -3.0);
}

TEST(TypedNumber, IsNothingElse) {
  for (const char* text :
       {"", " ", "0x20", "1e9", "inf", "nan", "1,5", "12 ", "--1", "1.2.3"}) {
    EXPECT_EQ(typed_number(text), std::nullopt) << text;
  }
}

}  // namespace typed_number_test
}  // namespace jnd::app::gui
