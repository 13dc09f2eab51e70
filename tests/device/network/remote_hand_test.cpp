#include "device/network/remote_hand.h"

#include <gtest/gtest.h>

namespace jnd::device {
namespace remote_hand_test {

TEST(RemoteHand, TheNewestOrderHoldsAllThatWasAskedFor) {
  RemoteHand hand;
  EXPECT_EQ(hand.order_after({}), nullptr);
  hand.begin_strokes({.num_strokes = 2}, core::RandomStream(1, "strokes"));
  hand.go_home();
  hand.put_fingers_back();
  const wire::Order* order = hand.order_after({});
  ASSERT_NE(order, nullptr);
  EXPECT_EQ(order->number, 3u);
  EXPECT_EQ(order->movement_number, 2u);
  EXPECT_EQ(order->num_put_back, 1u);
  EXPECT_FALSE(order->stroke);
  EXPECT_EQ(hand.order_after({.order_number = 3}), nullptr);
}

TEST(RemoteHand, ProgressOfAnOrderBeforeIsNotTakenForThatOfThisOne) {
  RemoteHand hand;
  EXPECT_TRUE(hand.is_home());
  hand.begin_strokes({}, core::RandomStream(1, "strokes"));
  (void)hand.order_after({.strokes_finished = 9, .order_number = 0, .is_home = true});
  EXPECT_EQ(hand.strokes_finished(), 0);
  EXPECT_FALSE(hand.is_home());
  (void)hand.order_after({.strokes_finished = 9, .order_number = 1, .is_home = true});
  EXPECT_EQ(hand.strokes_finished(), 9);
  EXPECT_TRUE(hand.is_home());
}

TEST(RemoteHand, AFreshConnectionHasNoOrders) {
  RemoteHand hand;
  hand.go_home();
  hand.put_fingers_back();
  hand.reset();
  EXPECT_TRUE(hand.is_home());
  EXPECT_EQ(hand.order_after({}), nullptr);
}

}  // namespace remote_hand_test
}  // namespace jnd::device
