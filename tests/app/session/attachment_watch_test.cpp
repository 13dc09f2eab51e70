#include "app/session/attachment_watch.h"

#include <gtest/gtest.h>

namespace jnd::app {
namespace attachment_watch_test {

core::Telemetry holding(std::uint8_t attached_bits) {
  core::Telemetry now;
  now.sample.attached_bits = attached_bits;
  return now;
}

TEST(AttachmentWatch, OnlyWhatHasHeldCanBeMissed) {
  AttachmentWatch watch;
  EXPECT_EQ(watch.loose_bits(holding(0b00000)), 0);
  watch.begin(holding(0b01011));
  EXPECT_EQ(watch.loose_bits(holding(0b01011)), 0);
  EXPECT_EQ(watch.loose_bits(holding(0b11111)), 0) << "one more is none less";
  EXPECT_EQ(watch.loose_bits(holding(0b00010)), 0b01001);
  EXPECT_EQ(watch.came_off_bits(holding(0b00010)), 0b01001);
}

TEST(AttachmentWatch, APointOnceHeldIsNotForgottenWhenSomethingElseBegins) {
  AttachmentWatch watch;
  watch.begin(holding(0b11111));
  watch.begin(holding(0b00111));
  EXPECT_EQ(watch.loose_bits(holding(0b00111)), 0b11000);
}

TEST(AttachmentWatch, APointThatCameOffAndHoldsAgainIsSeenUntilTheNextBegins) {
  AttachmentWatch watch;
  core::Telemetry now = holding(0b11101);
  now.num_detachments = {1, 1, 0, 0, 0};
  watch.begin(now);
  EXPECT_EQ(watch.came_off_bits(now), 0);
  now.num_detachments = {1, 2, 0, 1, 0};
  EXPECT_EQ(watch.came_off_bits(now), 0b01000) << "the second never held";
  EXPECT_EQ(watch.loose_bits(now), 0);
  watch.begin(now);
  EXPECT_EQ(watch.came_off_bits(now), 0);
}

TEST(AttachmentWatch, APointThatIsGivenUpIsNotMissedUntilItHoldsAgain) {
  AttachmentWatch watch;
  watch.begin(holding(0b11111));
  watch.give_up(0b01000);
  EXPECT_EQ(watch.loose_bits(holding(0b10111)), 0);
  EXPECT_EQ(watch.absent_bits(holding(0b10111)), 0) << "nobody has forgotten it";
  EXPECT_EQ(watch.loose_bits(holding(0b00111)), 0b10000);
  watch.begin(holding(0b11111));
  EXPECT_EQ(watch.loose_bits(holding(0b10111)), 0b01000);
}

TEST(AttachmentWatch, APointThatNeverHeldIsAbsentAndNotLoose) {
  AttachmentWatch watch;
  EXPECT_EQ(watch.absent_bits(holding(0b10111)), 0b01000);
  watch.begin(holding(0b10111));
  EXPECT_EQ(watch.absent_bits(holding(0b00111)), 0b01000);
  EXPECT_EQ(watch.loose_bits(holding(0b00111)), 0b10000);
}

TEST(AttachmentWatch, SaysInWordsWhichPointsItMeans) {
  EXPECT_EQ(words_of_points(0), "");
  EXPECT_EQ(words_of_points(0b01000), "the index finger");
  EXPECT_EQ(words_of_points(0b00101), "the inner palm and the thumb");
  EXPECT_EQ(words_of_points(0b11010), "the outer palm, the index finger and the middle finger");
  EXPECT_EQ(came_off_reason(0b10001), "came off: palm_inner, middle");
}

}  // namespace attachment_watch_test
}  // namespace jnd::app
