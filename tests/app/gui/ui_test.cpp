#include "app/gui/ui.h"

#include <gtest/gtest-spi.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "app/gui/headless_ui.h"

namespace jnd::app::gui {
namespace ui_test {

constexpr Rect kLeft = {100, 100, 200, 60};
constexpr Rect kRight = {400, 100, 200, 60};
const Chord kYes = {.key = letter('Y')};
const Chord kNo = {.key = letter('N')};

/// Draws two answers and counts how often each was given.
struct Answers {
  int yes = 0, no = 0;

  void draw(Ui& ui) {
    if (ui.button("yes", kLeft, "Thicker", {.tone = Tone::kPrimary, .key = kYes})) ++yes;
    if (ui.button("no", kRight, "Not thicker", {.key = kNo})) ++no;
  }
};

TEST(Button, AnswersToItsKeyExactlyOnce) {
  HeadlessUi ui;
  Answers answers;
  const auto draw = [&](Ui& frame) { answers.draw(frame); };
  ui.press(kYes);
  ui.frame(draw);
  EXPECT_EQ(answers.yes, 1);
  ui.frame(draw);
  EXPECT_EQ(answers.yes, 1);
  EXPECT_EQ(answers.no, 0);
}

TEST(Button, OfTwoThatHaveOneKeyTheTestsHear) {
  HeadlessUi ui;
  EXPECT_NONFATAL_FAILURE(ui.frame([](Ui& frame) {
    (void)frame.button("yes", kLeft, "Thicker", {.key = kYes});
    (void)frame.button("other", kRight, "Note", {.key = kYes});
  }),
                          "has the key Y");
  EXPECT_NONFATAL_FAILURE(ui.frame([](Ui& frame) {
    (void)frame.button("yes", kLeft, "Thicker", {.key = kYes});
    (void)frame.pressed(kYes);
  }),
                          "has the key Y");
  // A disabled button and a button below a dialog leave their key to others.
  ui.frame([](Ui& frame) {
    (void)frame.button("yes", kLeft, "Thicker", {.key = kYes});
    (void)frame.button("other", kRight, "Note", {.key = kYes, .enabled = false});
    (void)frame.begin_dialog("sure", 300, 200);
    (void)frame.button("sure_yes", kLeft, "Yes", {.key = kYes});
    frame.end_dialog();
  });
}

TEST(Button, IsNotReachedByWhatIsTypedAndClickedWhileInputIsHeld) {
  HeadlessUi ui;
  Answers answers;
  bool is_held = true;
  const auto draw = [&](Ui& frame) {
    answers.draw(frame);
    if (is_held) frame.hold_input();
  };
  ui.one_frame(draw);
  ui.press(kYes);
  ui.click("no");
  for (int i = 0; i < 5; ++i) ui.one_frame(draw);
  EXPECT_EQ(answers.yes + answers.no, 0);
  EXPECT_FALSE(ui.ui().wants_another_frame()) << "nothing can happen before it is let go";
  is_held = false;
  ui.frame(draw);
  EXPECT_EQ(answers.yes, 1);
  EXPECT_EQ(answers.no, 1);
}

TEST(Button, AnswersToAClickExactlyOnceAtEveryScale) {
  for (const float scale : {1.0f, 1.5f}) {
    HeadlessUi ui(1280, 720, scale);
    Answers answers;
    const auto draw = [&](Ui& frame) { answers.draw(frame); };
    ui.frame(draw);
    ui.click("no");
    ui.frame(draw);
    ui.frame(draw);
    EXPECT_EQ(answers.no, 1) << scale;
    EXPECT_EQ(answers.yes, 0) << scale;
  }
}

TEST(Button, IsNotUsedByAClickThatBeganOrEndedElsewhere) {
  HeadlessUi ui;
  Answers answers;
  const auto draw = [&](Ui& frame) { answers.draw(frame); };
  ui.move(200, 130);
  ui.mouse_down();
  ui.move(500, 130);
  ui.mouse_up();
  ui.frame(draw);
  EXPECT_EQ(answers.yes + answers.no, 0);
}

TEST(Button, EveryKeyPressedInATransitionCountsOnceAndInOrder) {
  HeadlessUi ui;
  std::string seen;
  for (int i = 0; i < 20; ++i) ui.press(i % 3 == 0 ? kNo : kYes);
  ui.frame([&](Ui& frame) {
    if (frame.button("yes", kLeft, "Thicker", {.key = kYes})) seen += 'Y';
    if (frame.button("no", kRight, "Not thicker", {.key = kNo})) seen += 'N';
  });
  EXPECT_EQ(seen, "NYYNYYNYYNYYNYYNYYNY");
}

TEST(Button, AHeldKeyAnswersOnceUnlessItRepeats) {
  HeadlessUi ui;
  int once = 0;
  int often = 0;
  const auto draw = [&](Ui& frame) {
    once += frame.button("once", kLeft, "Answer", {.key = kYes}) ? 1 : 0;
    often += frame.button("often", kRight, "Raise", {.key = kNo, .repeats = true}) ? 1 : 0;
  };
  for (const Chord& chord : {kYes, kNo}) {
    ui.hold(chord, 1);
    ui.frame(draw);
    ui.queue().key({.chord = chord, .action = KeyEvent::Action::kRepeat});
    ui.frame(draw);
    ui.release(chord);
    ui.frame(draw);
  }
  EXPECT_EQ(once, 1);
  EXPECT_EQ(often, 3);
}

TEST(Button, HeldWithTheMouseGoesOnAfterAWhileIfItRepeats) {
  HeadlessUi ui;
  ui.frame_s = 0.1f;
  int steps = 0;
  const auto draw = [&](Ui& frame) {
    steps += frame.button("raise", kLeft, "Raise", {.repeats = true}) ? 1 : 0;
  };
  ui.move(200, 130);
  ui.mouse_down();
  for (int i = 0; i < 4; ++i) ui.one_frame(draw);
  EXPECT_EQ(steps, 1);
  for (int i = 0; i < 6; ++i) ui.one_frame(draw);
  EXPECT_GE(steps, 5);
  EXPECT_TRUE(ui.ui().wants_another_frame());
  ui.mouse_up();
  ui.frame(draw);
  const int before = steps;
  ui.frame(draw);
  EXPECT_EQ(steps, before);
}

TEST(Button, TheEmergencyStopAnswersWhenTheMouseGoesDown) {
  HeadlessUi ui;
  int stops = 0;
  const auto draw = [&](Ui& frame) {
    stops += frame.button("stop", kLeft, "Stop", {.tone = Tone::kDanger, .at_once = true});
  };
  ui.move(200, 130);
  ui.mouse_down();
  ui.frame(draw);
  EXPECT_EQ(stops, 1);
  ui.mouse_up();
  ui.frame(draw);
  EXPECT_EQ(stops, 1);
}

TEST(Button, DisabledItAnswersToNothingAndLeavesItsKeyToOthers) {
  HeadlessUi ui;
  int used = 0;
  int other = 0;
  const auto draw = [&](Ui& frame) {
    used += frame.button("yes", kLeft, "Yes", {.key = kYes, .enabled = false});
    other += frame.pressed(kYes);
  };
  ui.press(kYes);
  ui.click(200, 130);
  ui.frame(draw);
  EXPECT_EQ(used, 0);
  EXPECT_EQ(other, 1);
  EXPECT_FALSE(ui.drawn().find("yes")->enabled);
}

TEST(Keys, BelongToTheFirstControlThatAsks) {
  HeadlessUi ui;
  int first = 0;
  int second = 0;
  const auto draw = [&](Ui& frame) {
    first += frame.button("first", kLeft, "First", {.key = kYes});
    second += frame.button("second", kRight, "Second", {.key = kYes});
    second += frame.pressed(kYes);
  };
  ui.may_share_keys = true;
  ui.press(kYes);
  ui.frame(draw);
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 0);
}

TEST(Dialog, TakesKeysAndClicksFromWhatIsUnderIt) {
  HeadlessUi ui;
  Answers below;
  int inside = 0;
  int after = 0;
  const auto draw = [&](Ui& frame) {
    below.draw(frame);
    const Rect place = frame.begin_dialog("note", 800, 600);
    inside += frame.button("save", {place.x, place.y, 100, 40}, "Save", {.key = kYes});
    frame.end_dialog();
    after += frame.button("stop", {1400, 10, 100, 40}, "Stop", {.key = {.key = Key::kEscape}});
  };
  ui.frame(draw);
  ui.frame(draw);
  EXPECT_FALSE(ui.drawn().find("no")->enabled);
  ui.press(kYes);
  ui.press(kNo);
  ui.press(Key::kEscape);
  ui.click(500, 130);
  ui.frame(draw);
  EXPECT_EQ(below.yes + below.no, 0);
  EXPECT_EQ(inside, 1);
  EXPECT_EQ(after, 1);
  ui.click("save");
  ui.frame(draw);
  ui.click("stop");
  ui.frame(draw);
  EXPECT_EQ(inside, 2);
  EXPECT_EQ(after, 2);
}

TEST(Dialog, WhatIsTypedWhileItOpensIsForItAndWhatFollowsItsEndIsForTheRest) {
  HeadlessUi ui;
  Answers below;
  bool is_open = false;
  std::string note;
  const auto draw = [&](Ui& frame) {
    below.draw(frame);
    const bool was_open = is_open;
    if (was_open) {
      Rect place = frame.begin_dialog("note", 600, 400);
      const bool ended = frame.text_field("text", place.take_top(44), note);
      frame.end_dialog();
      if (ended) is_open = false;
    }
    // The header comes last, so the dialog is drawn only from the next frame on.
    if (frame.pressed({.key = letter('N'), .control = true})) is_open = true;
  };
  ui.press({.key = letter('N'), .control = true});
  ui.type("yy n");
  ui.press(Key::kEnter);
  ui.press(kYes);
  ui.frame(draw);
  EXPECT_EQ(note, "yy n");
  EXPECT_EQ(below.no, 0);
  EXPECT_EQ(below.yes, 1);
  EXPECT_FALSE(is_open);
}

TEST(Dialog, WhatIsTypedRightAfterTheClickThatOpensItIsForIt) {
  HeadlessUi ui;
  Answers below;
  std::string note;
  bool is_open = false;
  const auto draw = [&](Ui& frame) {
    below.draw(frame);
    if (is_open) {
      Rect place = frame.begin_dialog("note", 600, 400);
      (void)frame.text_field("text", place.take_top(44), note);
      frame.end_dialog();
    }
    if (frame.button("write", {700, 10, 100, 40}, "Note")) is_open = true;
  };
  ui.frame(draw);
  ui.click("write");
  ui.type("yn");
  ui.frame(draw);
  EXPECT_EQ(note, "yn");
  EXPECT_EQ(below.yes + below.no, 0);
}

TEST(Dialog, NothingBelowItLooksAsIfItCouldBeClicked) {
  HeadlessUi ui;
  bool below = false;
  bool inside = false;
  ui.move(800, 500);
  const auto draw = [&](Ui& frame) {
    below = frame.hovered({0, 0, 1600, 1000});
    const Rect place = frame.begin_dialog("note", 600, 400);
    inside = frame.hovered(place);
    frame.end_dialog();
  };
  ui.one_frame(draw);
  ui.one_frame(draw);
  EXPECT_FALSE(below);
  EXPECT_TRUE(inside);
}

TEST(Dialog, GivesTheKeyboardToItsFirstFieldWhateverFieldsAreBelow) {
  HeadlessUi ui;
  std::string below, reason, text;
  const auto draw = [&](Ui& frame) {
    (void)frame.text_field("below", kLeft, below);
    Rect place = frame.begin_dialog("undo", 600, 400);
    (void)frame.text_field("reason", place.take_top(44, 10), reason);
    (void)frame.text_area("text", place.take_top(100), text);
    frame.end_dialog();
  };
  ui.one_frame(draw);
  ui.type("why");
  ui.press(Key::kTab);
  ui.type("more");
  ui.press(Key::kTab);
  ui.frame(draw);
  EXPECT_EQ(reason, "why");
  EXPECT_EQ(text, "more");
  EXPECT_EQ(below, "");
}

TEST(Dialog, KeysAndClicksOfTheFrameInWhichItClosedByItselfAreNotLost) {
  for (const bool by_key : {true, false}) {
    HeadlessUi ui;
    Answers below;
    bool is_open = true;
    const auto draw = [&](Ui& frame) {
      below.draw(frame);
      if (!is_open) return;
      frame.begin_dialog("fault", 300, 200);
      frame.end_dialog();
    };
    ui.frame(draw);
    ui.frame(draw);
    is_open = false;
    if (by_key) {
      ui.press(kYes);
    } else {
      ui.click(200, 130);
    }
    ui.frame(draw);
    EXPECT_EQ(below.yes, 1) << by_key;
  }
}

TEST(Dialog, AClickThatBeganBeforeItWasThereIsNotForIt) {
  HeadlessUi ui;
  int inside = 0;
  bool is_open = false;
  const auto draw = [&](Ui& frame) {
    if (!is_open) return;
    const Rect place = frame.begin_dialog("fault", 400, 300);
    inside += frame.button("rearm", place, "Re-arm");
    frame.end_dialog();
  };
  ui.frame(draw);
  ui.move(800, 500);
  ui.mouse_down();
  is_open = true;  // The dialog opens in the very frame of the press.
  ui.frame(draw);
  ui.mouse_up();
  ui.frame(draw);
  EXPECT_EQ(inside, 0);
  ui.click("rearm");
  ui.frame(draw);
  EXPECT_EQ(inside, 1);
}

TEST(TextField, LettersGoToItAloneWhileItIsEdited) {
  HeadlessUi ui;
  Answers answers;
  std::string name;
  bool focus = true;
  const auto draw = [&](Ui& frame) {
    answers.draw(frame);
    (void)frame.text_field("name", {100, 300, 300, 44}, name, "who",
                           std::exchange(focus, false));
  };
  ui.one_frame(draw);
  ui.type("yny");
  ui.frame(draw);
  EXPECT_EQ(name, "yny") << "typed before the field had the keyboard";
  EXPECT_EQ(answers.yes + answers.no, 0);
  EXPECT_TRUE(ui.ui().is_editing());
  ui.press(Key::kBackspace);
  ui.press(Key::kLeft);
  ui.type("X");
  ui.frame(draw);
  EXPECT_EQ(name, "yXn");
}

TEST(TextField, EnterEndsItAndIsNobodyElses) {
  HeadlessUi ui;
  std::string name;
  int ended = 0;
  int saved = 0;
  bool focus = true;
  const auto draw = [&](Ui& frame) {
    saved += frame.button("save", kLeft, "Save", {.key = {.key = Key::kEnter}});
    ended += frame.text_field("name", kRight, name, "", std::exchange(focus, false));
  };
  ui.frame(draw);
  ui.type("P07");
  ui.press(Key::kEnter);
  ui.frame(draw);
  EXPECT_EQ(name, "P07");
  EXPECT_EQ(ended, 1);
  EXPECT_EQ(saved, 0);
  EXPECT_FALSE(ui.ui().is_editing());
  ui.press(Key::kEnter);
  ui.frame(draw);
  EXPECT_EQ(ended, 1);
  EXPECT_EQ(saved, 1);
}

TEST(TextField, EscapeAndFunctionKeysGoPastItButUndoAndPasteDoNot) {
  HeadlessUi ui;
  std::string name;
  std::string others;
  bool focus = true;
  const auto draw = [&](Ui& frame) {
    (void)frame.text_field("name", kRight, name, "", std::exchange(focus, false));
    if (frame.pressed({.key = Key::kEscape})) others += "stop ";
    if (frame.pressed({.key = Key::kF1})) others += "keys ";
    if (frame.pressed({.key = letter('Z'), .control = true})) others += "undo ";
    if (frame.pressed({.key = letter('V'), .control = true})) others += "paste ";
    if (frame.pressed({.key = letter('N'), .control = true})) others += "note ";
  };
  ui.frame(draw);
  ui.type("ab");
  ui.press({.key = letter('Z'), .control = true});
  ui.press({.key = letter('V'), .control = true});
  ui.press(Key::kEscape);
  ui.press(Key::kF1);
  ui.press({.key = letter('N'), .control = true});
  ui.frame(draw);
  EXPECT_EQ(others, "stop keys note ");
  EXPECT_TRUE(ui.ui().is_editing()) << "Escape would have taken back what was written";
}

TEST(TextField, TabGoesFromOneToTheNextAndAround) {
  HeadlessUi ui;
  std::string a, b, c;
  const auto draw = [&](Ui& frame) {
    (void)frame.text_field("a", {100, 100, 300, 44}, a);
    (void)frame.text_field("b", {100, 200, 300, 44}, b);
    (void)frame.text_area("c", {100, 300, 300, 144}, c);
  };
  for (const char* text : {"1", "2", "3", "4"}) {
    ui.press(Key::kTab);
    ui.type(text);
  }
  ui.press({.key = Key::kTab, .shift = true});
  ui.type("5");
  ui.frame(draw);
  EXPECT_EQ(a, "4");
  EXPECT_EQ(b, "2");
  EXPECT_NE(c.find('5'), std::string::npos);
}

TEST(TextField, AClickGivesItTheKeyboard) {
  HeadlessUi ui;
  std::string name = "P0";
  const auto draw = [&](Ui& frame) { (void)frame.text_field("name", kRight, name); };
  ui.frame(draw);
  ui.click("name");
  ui.type("7");
  ui.frame(draw);
  EXPECT_NE(name.find('7'), std::string::npos);
  EXPECT_EQ(name.size(), 3u);
}

TEST(TextArea, WrapsWhatIsTypedWithoutChangingIt) {
  HeadlessUi ui;
  std::string note;
  bool focus = true;
  const auto draw = [&](Ui& frame) {
    (void)frame.text_area("note", {100, 100, 220, 300}, note, "", std::exchange(focus, false));
  };
  const std::string text = "the participant moved faster than before, and said so. ";
  ui.frame(draw);
  ui.type(text);
  ui.press(Key::kEnter);
  ui.type("Second line");
  ui.frame(draw);
  EXPECT_EQ(note, text + "\nSecond line");
  // The cursor moves to the middle of the text, across a line that the field itself has broken.
  for (int i = 0; i < 40; ++i) ui.press(Key::kLeft);
  ui.type("QQ");
  ui.press(Key::kBackspace);
  ui.frame(draw);
  EXPECT_EQ(note.size(), text.size() + 13);
  std::string without = note;
  std::erase(without, 'Q');
  EXPECT_EQ(without, text + "\nSecond line");
}

TEST(TextArea, IsWrittenOnAtItsEnd) {
  HeadlessUi ui;
  std::string note = "slower than before, in so many words that they need two lines";
  bool focus = true;
  const auto draw = [&](Ui& frame) {
    (void)frame.text_area("note", {100, 100, 320, 300}, note, "", std::exchange(focus, false));
  };
  ui.frame(draw);
  ui.type(", and");
  ui.frame(draw);
  EXPECT_TRUE(note.ends_with("two lines, and")) << note;
}

TEST(TextArea, ItsUndoIsSwitchedOffBecauseItWouldMeetOurLineEnds) {
  HeadlessUi ui;
  std::string note;
  bool focus = true;
  const auto draw = [&](Ui& frame) {
    (void)frame.text_area("note", {100, 100, 120, 300}, note, "", std::exchange(focus, false));
  };
  ui.frame(draw);
  ui.type("many words that need many lines in so narrow a field");
  const std::string expected = "many words that need many lines in so narrow a field";
  for (int i = 0; i < 10; ++i) ui.press({.key = letter('Z'), .control = true});
  ui.frame(draw);
  EXPECT_EQ(note, expected);
}

TEST(TextField, BelowADialogItIsShownButNotEdited) {
  HeadlessUi ui;
  std::string name = "P07";
  bool is_open = false;
  const auto draw = [&](Ui& frame) {
    (void)frame.text_field("name", kLeft, name);
    if (!is_open) return;
    frame.begin_dialog("question", 400, 300);
    frame.end_dialog();
  };
  ui.frame(draw);
  ui.click("name");
  ui.frame(draw);
  EXPECT_TRUE(ui.ui().is_editing());
  is_open = true;
  ui.frame(draw);
  ui.type("abc");
  ui.frame(draw);
  EXPECT_EQ(name, "P07");
  EXPECT_FALSE(ui.ui().is_editing());
  EXPECT_TRUE(ui.drawn().shows("P07"));
}

TEST(Keypad, WritesDigitsOnceAndTheyAreNoShortcutsThen) {
  HeadlessUi ui;
  std::string typed;
  int shortcut = 0;
  const auto draw = [&](Ui& frame) {
    typed += frame.typed_digits();
    if (frame.typed_backspace()) typed.pop_back();
    shortcut += frame.pressed({.key = letter('1')});
  };
  ui.type("12,56");
  ui.press(Key::kBackspace);
  // A key of the keypad without Num Lock sends no character.
  ui.queue().key({.chord = {.key = letter('7')}, .action = KeyEvent::Action::kPress});
  ui.frame(draw);
  EXPECT_EQ(typed, "12.57");
  EXPECT_EQ(shortcut, 0);
}

TEST(Keypad, ADigitHeldTooLongIsStillOne) {
  HeadlessUi ui;
  std::string typed;
  ui.hold({.key = letter('1')}, 5);
  ui.frame([&](Ui& frame) { typed += frame.typed_digits(); });
  EXPECT_EQ(typed, "1");
}

TEST(Keypad, LeavesDigitsToTheFieldThatIsEditedAndToAShortcutThatAskedFirst) {
  HeadlessUi ui;
  std::string typed, name;
  int shortcut = 0;
  bool focus = false;
  const auto draw = [&](Ui& frame) {
    shortcut += frame.row("first", kLeft, "Study", {.key = letter('1')});
    typed += frame.typed_digits();
    (void)frame.text_field("name", kRight, name, "", std::exchange(focus, false));
  };
  ui.type("1");
  ui.frame(draw);
  EXPECT_EQ(shortcut, 1);
  EXPECT_EQ(typed, "");
  focus = true;
  ui.frame(draw);
  ui.type("12");
  ui.frame(draw);
  EXPECT_EQ(name, "12");
  EXPECT_EQ(typed, "");
  EXPECT_EQ(shortcut, 1);
}

TEST(Scroll, MovesWithWheelKeysAndThumbAndHidesWhatIsOutside) {
  HeadlessUi ui;
  int used = 0;
  float top = 0;
  const Rect place = {100, 100, 300, 200};
  const auto draw = [&](Ui& frame) {
    Rect content = frame.begin_scroll("list", place, 1000);
    top = content.y;
    for (int i = 0; i < 10; ++i) {
      used += frame.row("row_" + std::to_string(i), content.take_top(100), "row");
    }
    frame.end_scroll();
  };
  ui.frame(draw);
  EXPECT_EQ(top, 100);
  EXPECT_EQ(ui.drawn().find("row_1")->place.height, 100);
  EXPECT_EQ(ui.drawn().find("row_2")->place.height, 0);
  ui.click(150, 350);  // The point lies below the place, where a third row would be.
  ui.frame(draw);
  EXPECT_EQ(used, 0);
  ui.wheel(-1);
  ui.frame(draw);
  EXPECT_EQ(top, 100) << "the mouse is elsewhere";
  ui.move(150, 150);
  ui.wheel(-1);
  ui.frame(draw);
  EXPECT_LT(top, 100);
  ui.press(Key::kEnd);
  ui.frame(draw);
  EXPECT_EQ(top, 100 - 800);
  ui.press(Key::kPageDown);
  ui.frame(draw);
  EXPECT_EQ(top, 100 - 800);
  ui.click("row_9");
  ui.frame(draw);
  EXPECT_EQ(used, 1);
  ui.move(395, 290);  // The point is on the scroll bar's thumb, which is at the end.
  ui.mouse_down();
  ui.move(395, 0);
  ui.mouse_up();
  ui.frame(draw);
  EXPECT_EQ(top, 100);
}

TEST(Drawn, HoldsEveryWidgetWithItsKeyAndPlaceAndEveryText) {
  HeadlessUi ui;
  Answers answers;
  std::string note = "noted";
  const Drawn& drawn = ui.frame([&](Ui& frame) {
    frame.set_view("run");
    answers.draw(frame);
    frame.text({10, 10, 60, 20}, "A sentence that is cut with an ellipsis");
    frame.heading({10, 40, 300, 20}, "Speed of the hand", "m/s");
    frame.chip(10, 60, "levels hidden", Colour::kBlue);
    (void)frame.text_field("note", {10, 300, 300, 40}, note);
    frame.note_drawn("hand sign fist");
  });
  EXPECT_EQ(drawn.view, "run");
  EXPECT_GT(drawn.frame, 0u);
  ASSERT_NE(drawn.find("yes"), nullptr);
  EXPECT_EQ(drawn.find("yes")->label, "Thicker");
  EXPECT_EQ(drawn.find("yes")->key, "Y");
  EXPECT_EQ(drawn.find("yes")->place, kLeft);
  EXPECT_EQ(drawn.find("nothing"), nullptr);
  for (const char* text :
       {"Thicker", "Not thicker", "cut with an ellipsis", "Speed of the hand", "m/s",
        "levels hidden", "noted", "hand sign fist"}) {
    EXPECT_TRUE(drawn.shows(text)) << text;
  }
  EXPECT_FALSE(drawn.shows("levels shown"));
}

TEST(Drawn, HoldsEveryLineOfLettersWhereItStandsAndWhetherItIsCut) {
  HeadlessUi ui;
  std::string note;
  const Drawn& drawn = ui.frame([&](Ui& frame) {
    frame.text({10, 10, 60, 20}, "A sentence that is cut");
    frame.text({10, 40, 120, 20}, "Broken into lines", {.wrap = true});
    frame.text({10, 200, 40, 20}, "Unterschiedsschwelle", {.wrap = true});
    (void)frame.button("go_on", {300, 10, 40, 40}, "Go on with it", {.key = {Key::kEnter}});
    (void)frame.text_field("note", {10, 300, 80, 40}, note, "a hint that is too long");
    (void)frame.begin_scroll("list", {400, 100, 50, 60}, 100);
    frame.text({400, 150, 200, 20}, "Clipped at its end");
    frame.text({400, 180, 200, 20}, "Scrolled away");
    frame.end_scroll();
    frame.chip(10, 400, "Whole", Colour::kBlue);
  });
  const auto line = [&](const std::string& part) {
    const auto found = std::ranges::find_if(drawn.lines, [&](const Drawn::Line& one) {
      return one.words.find(part) != std::string::npos;
    });
    return found == drawn.lines.end() ? Drawn::Line{} : *found;
  };
  EXPECT_TRUE(line("A sen").is_cut);
  EXPECT_TRUE(line("A sen").words.ends_with("…"));
  EXPECT_EQ(line("A sen").box, (Rect{10, 10, 60, 20}));
  EXPECT_FALSE(line("Broken").is_cut);
  EXPECT_FALSE(line("lines").is_cut);
  EXPECT_GT(line("lines").place.bottom(), line("lines").box.bottom()) << "it spills over";
  EXPECT_TRUE(line("Unt").is_cut) << "within a word";
  EXPECT_TRUE(line("a hint").is_cut);
  EXPECT_TRUE(line("Clipped").is_cut);
  EXPECT_LE(line("Clipped").place.right(), 450);
  EXPECT_EQ(line("Scrolled").words, "") << "nobody sees it";
  EXPECT_FALSE(line("Whole").is_cut);
  EXPECT_NEAR(line("Whole").place.width, ui.ui().text_width("Whole", Font::kSmallStrong), 1);
  EXPECT_FALSE(line("Enter").is_cut);
  ui.frame([](Ui& frame) {
    frame.text({10, 10, 300, 20}, "Below");
    (void)frame.button("below", {10, 40, 90, 40}, "Below");
    frame.text(frame.begin_dialog("dialog", 300, 200), "In it");
    frame.end_dialog();
  });
  EXPECT_TRUE(line("Below").is_covered);
  EXPECT_TRUE(drawn.find("below")->is_covered);
  EXPECT_FALSE(line("In it").is_covered);
}

TEST(Text, TakesTheHeightThatWasSaid) {
  HeadlessUi ui;
  ui.frame([&](Ui& frame) {
    for (const Align align : {Align::kLeft, Align::kCentre}) {
      const TextStyle style = {.font = Font::kTitle, .align = align, .wrap = true};
      const std::string words = "Show one finger. At the ready sign, ask the question.";
      const float height = frame.text_height(420, words, style);
      EXPECT_EQ(height, 2 * frame.line_height(Font::kTitle));
      EXPECT_EQ(frame.text({0, 0, 420, 300}, words, style), height);
    }
    EXPECT_EQ(frame.text_width("", Font::kBody), 0);
    EXPECT_NEAR(frame.text_width("Hand Hand", Font::kBody),
                2 * frame.text_width("Hand", Font::kBody) + frame.text_width(" ", Font::kBody),
                2);
  });
}

TEST(Text, WhateverTheBytesAreItIsDrawn) {
  HeadlessUi ui;
  ui.frame([](Ui& frame) {
    for (const char* words :
         {"", "\xff\xfe\x80", "\xe2\x82", "\xf0\x9f\x91\x8d", "\n\n", " "}) {
      for (const bool wrap : {false, true}) {
        frame.text({0, 0, 30, 30}, words, {.align = Align::kCentre, .wrap = wrap});
        frame.heading({0, 0, 30, 30}, words);
      }
    }
    frame.text({0, 0, -5, -5}, "no room", {.wrap = true});
  });
}

namespace {

const Drawn::Line* line_with(const Drawn& drawn, const std::string& part) {
  const auto found = std::ranges::find_if(drawn.lines, [&](const Drawn::Line& one) {
    return one.words.find(part) != std::string::npos;
  });
  return found == drawn.lines.end() ? nullptr : &*found;
}

}  // namespace

TEST(Text, OfTheProgramIsOnTwoLinesOrSmallerBeforeItIsCut) {
  HeadlessUi ui;
  ui.frame([](Ui& frame) {
    const float width = frame.text_width("Größenschätzung", Font::kBody);
    frame.text({10, 10, width + 20, 46}, "Größenschätzung und mehr");
    frame.text({10, 100, width - 4, 20}, "Größenschätzung");
  });
  const auto is_line = [&](const char* words) {
    return [words](const Drawn::Line& line) { return line.words == words && !line.is_cut; };
  };
  EXPECT_EQ(std::ranges::count_if(ui.drawn().lines, is_line("Größenschätzung")), 2);
  EXPECT_EQ(std::ranges::count_if(ui.drawn().lines, is_line("und mehr")), 1);
  EXPECT_LT(ui.drawn().lines.back().place.height, 23) << "smaller than the letters of a body";
}

TEST(Text, ThatIsCutShowsWholeWhenItIsPointedAt) {
  HeadlessUi ui;
  const std::string title = "A title that an author wrote and that is of any length";
  const auto draw = [&](Ui& frame) {
    frame.text({10, 10, 80, 20}, title, {.any_length = true});
    frame.text({10, 50, 60, 20}, "The program's words that have no room at all");
    frame.text({10, 90, 400, 20}, "These have room", {.any_length = true});
  };
  const Drawn& drawn = ui.frame(draw);
  ASSERT_NE(line_with(drawn, "A tit"), nullptr);
  EXPECT_TRUE(line_with(drawn, "A tit")->is_cut);
  EXPECT_TRUE(line_with(drawn, "A tit")->shows_whole);
  EXPECT_TRUE(line_with(drawn, "The")->is_cut);
  EXPECT_FALSE(line_with(drawn, "The")->shows_whole) << "it is to have room";
  EXPECT_FALSE(line_with(drawn, "These")->is_cut);
  EXPECT_EQ(std::ranges::count(drawn.texts, title), 1);
  ui.move(40, 20);
  EXPECT_EQ(std::ranges::count(ui.frame(draw).texts, title), 2) << "the tooltip";
  ui.move(40, 100);
  EXPECT_EQ(std::ranges::count(ui.frame(draw).texts, "These have room"), 1);
}

TEST(Button, GivesUpLargeLettersAndItsKeyBeforeItsWordsAreCut) {
  HeadlessUi ui;
  ui.may_share_keys = true;
  const ButtonStyle style{.key = {letter('W'), true}};
  ui.frame([&](Ui& frame) {
    const float words = frame.text_width("Leave the session", Font::kSmallStrong);
    (void)frame.button("wide", {10, 10, frame.button_width("Leave", style), 30}, "Leave",
                       style);
    (void)frame.button("low", {10, 50, words + 14, 26}, "Leave the session", style);
    (void)frame.button("high", {10, 90, words + 14, 48}, "Leave the session", style);
    (void)frame.button("narrow", {10, 150, 30, 30}, "Leave the session", style);
  });
  const auto has_cap = [&](float y) {
    return std::ranges::any_of(ui.drawn().lines, [&](const Drawn::Line& line) {
      return line.words == "Ctrl W" && line.place.y > y && line.place.y < y + 40;
    });
  };
  EXPECT_TRUE(has_cap(5));
  EXPECT_FALSE(has_cap(45)) << "no room for both";
  EXPECT_TRUE(has_cap(88)) << "on two lines there is";
  EXPECT_NE(line_with(ui.drawn(), "Leave the session"), nullptr);
  EXPECT_TRUE(line_with(ui.drawn(), "…")->is_cut);
  EXPECT_EQ(ui.drawn().find("low")->key, "Ctrl W") << "it answers to it all the same";
}

TEST(Rect, CutsStripsOffItsSides) {
  Rect rest = {0, 0, 100, 80};
  EXPECT_EQ(rest.take_top(10, 5), (Rect{0, 0, 100, 10}));
  EXPECT_EQ(rest.take_bottom(10, 5), (Rect{0, 70, 100, 10}));
  EXPECT_EQ(rest.take_left(20, 4), (Rect{0, 15, 20, 50}));
  EXPECT_EQ(rest.take_right(20, 4), (Rect{80, 15, 20, 50}));
  EXPECT_EQ(rest, (Rect{24, 15, 52, 50}));
  EXPECT_EQ(rest.middle(2, 10), (Rect{49, 35, 2, 10}));
  EXPECT_EQ((Rect{0, 0, 10, 10}.common({5, 8, 10, 10})), (Rect{5, 8, 5, 2}));
  EXPECT_EQ((Rect{0, 0, 10, 10}.common({50, 8, 10, 10})).width, 0);
}

}  // namespace ui_test
}  // namespace jnd::app::gui
