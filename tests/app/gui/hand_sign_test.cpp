#include "app/gui/hand_sign.h"

#include <gtest/gtest.h>
#include <imgui.h>

#include <cmath>
#include <set>

#include "app/gui/headless_ui.h"

namespace jnd::app::gui {
namespace hand_sign_test {

constexpr HandSign kSigns[] = {HandSign::kFist,    HandSign::kOneFinger, HandSign::kTwoFingers,
                               HandSign::kReady,   HandSign::kRaise,     HandSign::kLower,
                               HandSign::kMatches, HandSign::kOpenHand};

TEST(HandSign, EveryOneIsDrawnWithinItsPlaceAndNoted) {
  HeadlessUi ui;
  for (const float size : {34.0f, 300.0f}) {
    for (const HandSign sign : kSigns) {
      ui.frame([&](Ui& frame) {
        const int before = frame.draw_list().VtxBuffer.Size;
        draw_hand_sign(frame, {100, 50, size, size}, sign);
        EXPECT_GT(frame.draw_list().VtxBuffer.Size, before + 100) << words(sign);
        for (int i = before; i < frame.draw_list().VtxBuffer.Size; ++i) {
          const ImVec2 at = frame.draw_list().VtxBuffer[i].pos;
          ASSERT_TRUE(at.x >= 99 && at.x <= 101 + size) << words(sign) << ' ' << at.x;
          ASSERT_TRUE(at.y >= 49 && at.y <= 51 + size) << words(sign) << ' ' << at.y;
        }
      });
      EXPECT_TRUE(ui.drawn().shows(std::string("hand sign ") + words(sign)));
    }
  }
}

TEST(HandSign, EachHasWordsOfItsOwn) {
  std::set<std::string> all;
  for (const HandSign sign : kSigns) {
    EXPECT_FALSE(std::string(words(sign)).empty());
    EXPECT_TRUE(all.insert(words(sign)).second) << words(sign);
  }
}

TEST(HandSign, NoneIsNothing) {
  HeadlessUi ui;
  ui.frame([](Ui& frame) {
    const int before = frame.draw_list().VtxBuffer.Size;
    draw_hand_sign(frame, {0, 0, 100, 100}, HandSign::kNone);
    EXPECT_EQ(frame.draw_list().VtxBuffer.Size, before);
  });
  EXPECT_FALSE(ui.drawn().shows("hand sign"));
}

}  // namespace hand_sign_test
}  // namespace jnd::app::gui
