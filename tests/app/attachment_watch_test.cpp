#include "app/attachment_watch.h"

#include <gtest/gtest.h>

namespace jnd::app {
namespace {

TEST(AttachmentWatch, OnlyWhatHasHeldCanBeMissed) {
  AttachmentWatch watch;
  EXPECT_EQ(watch.loose_bits(0b00000), 0);
  watch.begin(0b01011);
  EXPECT_EQ(watch.loose_bits(0b01011), 0);
  EXPECT_EQ(watch.loose_bits(0b11111), 0) << "one more is none less";
  EXPECT_EQ(watch.loose_bits(0b00010), 0b01001);
}

TEST(AttachmentWatch, APointOnceHeldIsNotForgottenWhenSomethingElseBegins) {
  AttachmentWatch watch;
  watch.begin(0b11111);
  watch.begin(0b00111);
  EXPECT_EQ(watch.loose_bits(0b00111), 0b11000);
}

TEST(AttachmentWatch, SaysInWordsWhichPointsItMeans) {
  EXPECT_EQ(words_of_points(0), "");
  EXPECT_EQ(words_of_points(0b01000), "the index finger");
  EXPECT_EQ(words_of_points(0b00101), "the inner palm and the thumb");
  EXPECT_EQ(words_of_points(0b11010), "the outer palm, the index finger and the middle finger");
  EXPECT_EQ(came_off_reason(0b10001), "came off: palm_inner, middle");
}

}  // namespace
}  // namespace jnd::app
