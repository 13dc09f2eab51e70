#include <gtest/gtest.h>

#include "app/gui/headless_ui.h"
#include "app/gui/views/run_view_fixture.h"

namespace jnd::app::gui {
namespace item_card_test {

class ItemCardTest : public RunViewTest {
 protected:
  static SessionView tick(int index) {
    SessionView view = item_of({.name = "item_" + std::to_string(index),
                                .text = "Power on.",
                                .index = index,
                                .count = 7});
    view.stage = 1;
    return view;
  }
  /// Draws frames for this time, in which nothing is pressed.
  void pass(const SessionView& view, float duration_s) {
    ui_.frame_s = duration_s / 4;
    for (int i = 0; i < 4; ++i) draw(view);
    ui_.frame_s = 1.0f / 60;
  }
};

TEST_F(ItemCardTest, AnItemIsTickedBySpaceOnceItCanHaveBeenRead) {
  draw(tick(1));
  ui_.press(Key::kSpace);
  EXPECT_TRUE(draw(tick(1)).empty()) << "it has only just appeared";
  EXPECT_FALSE(ui_.drawn().find("item_done")->enabled);
  pass(tick(1), 0.6f);
  EXPECT_EQ(after_key<operate::AnswerItem>(tick(1), {Key::kSpace}).answer, "done");
}

TEST_F(ItemCardTest, SpaceThatIsHeldTicksOneItem) {
  pass(tick(1), 0.6f);
  ui_.hold({Key::kSpace}, 0);
  EXPECT_EQ(only<operate::AnswerItem>(draw(tick(1))).item, "item_1");
  for (int repeat = 0; repeat < 20; ++repeat) {
    ui_.frame_s = 0.1f;
    ui_.queue().key({.chord = {Key::kSpace}, .action = KeyEvent::Action::kRepeat});
    EXPECT_TRUE(draw(tick(2)).empty());
  }
  ui_.release({Key::kSpace});
  pass(tick(2), 0.6f);
  EXPECT_EQ(after_key<operate::AnswerItem>(tick(2), {Key::kSpace}).item, "item_2");
}

TEST_F(ItemCardTest, ASystemThatRepeatsByReleasingTicksOneItem) {
  pass(tick(1), 0.6f);
  ui_.hold({Key::kSpace}, 0);
  EXPECT_EQ(draw(tick(1)).size(), 1U);
  for (int repeat = 0; repeat < 30; ++repeat) {
    ui_.frame_s = 0.02f;
    ui_.release({Key::kSpace});
    ui_.hold({Key::kSpace}, 0);
    EXPECT_TRUE(draw(tick(2)).empty()) << repeat;
  }
}

TEST_F(ItemCardTest, BlanksAreNoAnswer) {
  const SessionView asked =
      item_of({.name = "why", .kind = ItemView::Kind::kText, .text = "Why?"});
  draw(asked);
  ui_.type("   ");
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(asked).empty());
  EXPECT_TRUE(ui_.drawn().shows("type an answer first"));
  ui_.type("so");
  ui_.press(Key::kEnter);
  EXPECT_EQ(only<operate::AnswerItem>(draw(asked)).answer, "   so");
}

TEST_F(ItemCardTest, EachOfSeveralWordsIsOne) {
  const SessionView asked = item_of(
      {.name = "words", .kind = ItemView::Kind::kWords, .text = "Like what?", .num_words = 3});
  draw(asked);
  ui_.type("honey, ,oil");
  ui_.press(Key::kEnter);
  EXPECT_TRUE(draw(asked).empty());
  EXPECT_TRUE(ui_.drawn().shows("expected 3 words"));
}

TEST_F(ItemCardTest, WhatSpeaksAgainstAnAnswerStandsBesideItAndTheSessionIsCounted) {
  SessionView view = comparison();
  view.answers[0].hint = "no stroke in the test";
  view.num_trials = 96;
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("no stroke in the test"));
  EXPECT_TRUE(ui_.drawn().shows("22 of 96"));
  view.num_trials_is_expected = true;
  draw(view);
  EXPECT_TRUE(ui_.drawn().shows("22 of about 96"));
}

}  // namespace item_card_test
}  // namespace jnd::app::gui
