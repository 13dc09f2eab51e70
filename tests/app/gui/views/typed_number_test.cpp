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
    EXPECT_EQ(typed_number(text, /*takes_comma=*/false), std::nullopt) << text;
  }
}

TEST(TypedNumber, HasACommaWhereHalfIsWrittenSo) {
  EXPECT_EQ(typed_number("0,5", /*takes_comma=*/true), 0.5);
  EXPECT_EQ(typed_number("-1,85", /*takes_comma=*/true), -1.85);
  EXPECT_EQ(typed_number("0.5", /*takes_comma=*/true), 0.5) << "a point is understood, too";
  for (const char* text : {"1.000,5", "1,000,5", ",", "0,5 m", "1,5e3"}) {
    EXPECT_EQ(typed_number(text, /*takes_comma=*/true), std::nullopt) << text;
  }
  EXPECT_EQ(typed_number("1,000", /*takes_comma=*/false), std::nullopt)
      << "it might be thousand";
}

TEST(TypedNumber, IsKeptWithAPoint) {
  EXPECT_EQ(with_point("0,5"), "0.5");
  EXPECT_EQ(with_point("1.75"), "1.75");
  EXPECT_EQ(with_point("12"), "12");
}

TEST(TypedNumber, TheLocaleSaysHowHalfIsWritten) {
  for (const char* locale : {"de_DE.UTF-8", "de", "fr_FR", "it_IT@euro", "pt_BR.UTF-8"}) {
    EXPECT_TRUE(writes_decimal_comma(locale)) << locale;
  }
  for (const char* locale : {"en_US.UTF-8", "C", "C.UTF-8", "POSIX", "ja_JP.UTF-8",
                             "de_CH.UTF-8", "es_MX", "", "deu"}) {
    EXPECT_FALSE(writes_decimal_comma(locale)) << locale;
  }
}

}  // namespace typed_number_test
}  // namespace jnd::app::gui
