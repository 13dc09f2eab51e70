#include "app/gui/input_queue.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace jnd::app::gui {
namespace input_queue_test {

using Action = KeyEvent::Action;

void key(InputQueue& queue, char capital, Action action) {
  queue.key({.chord = {.key = letter(capital)}, .action = action});
}

void tap(InputQueue& queue, char capital) {
  key(queue, capital, Action::kPress);
  queue.character(static_cast<std::uint32_t>(capital));
  key(queue, capital, Action::kRelease);
}

/// Returns every frame as text: "Y+" for a press, "Y*" for a repetition, "Y-" for a release,
/// and "'Y'" for a character.
std::vector<std::string> frames(InputQueue& queue) {
  std::vector<std::string> all;
  bool has_more = true;
  while (has_more) {
    const FrameInput input = queue.next_frame();
    std::string text;
    for (const KeyEvent& event : input.keys) {
      text += words(event.chord);
      text += event.action == Action::kPress    ? "+ "
              : event.action == Action::kRepeat ? "* "
                                                : "- ";
    }
    for (const std::uint32_t c : input.characters) {
      text += "'" + std::string(1, static_cast<char>(c)) + "' ";
    }
    all.push_back(text);
    has_more = input.has_more;
  }
  return all;
}

TEST(InputQueue, AKeyPressedAndReleasedBetweenTwoFramesIsSeenInBoth) {
  InputQueue queue;
  tap(queue, 'Y');
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"Y+ 'Y' ", "Y- "}));
  EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, AStormOfKeysDoesNotKeepWhatComesAfterItWaitingForLong) {
  InputQueue queue;
  for (int i = 0; i < 1000; ++i) tap(queue, i % 2 == 0 ? 'Y' : 'N');
  queue.mouse_button(true);
  int num_frames = 0;
  while (!queue.next_frame().mouse.down) ASSERT_LT(++num_frames, 150);
  while (!queue.empty()) (void)queue.next_frame();
  tap(queue, 'Z');
  EXPECT_EQ(frames(queue).front(), "Z+ 'Z' ") << "none is held that was not pressed";
}

TEST(InputQueue, TwoKeysAtOnceGoToTwoFramesInTheirOrder) {
  InputQueue queue;
  key(queue, 'Y', Action::kPress);
  key(queue, 'N', Action::kPress);
  key(queue, 'Y', Action::kRelease);
  key(queue, 'N', Action::kRelease);
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"Y+ ", "N+ Y- ", "N- "}));
}

TEST(InputQueue, TheSameKeyTwiceIsTwoPresses) {
  InputQueue queue;
  tap(queue, 'Y');
  tap(queue, 'Y');
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"Y+ 'Y' ", "Y- ", "Y+ 'Y' ", "Y- "}));
}

TEST(InputQueue, EachCharacterComesWithItsOwnKeyAndEnterAfterThem) {
  InputQueue queue;
  tap(queue, '1');
  tap(queue, '2');
  queue.key({.chord = {.key = Key::kEnter}, .action = Action::kPress});
  // The character is of no key that we know, and still does not overtake the Enter.
  queue.character('x');
  EXPECT_EQ(frames(queue),
            (std::vector<std::string>{"1+ '1' ", "1- 2+ '2' ", "2- Enter+ ", "'x' "}));
}

TEST(InputQueue, WhileATextIsEditedAFrameTakesItsLettersUpToTheNextCommand) {
  InputQueue queue;
  for (const char letter_of_text : {'H', 'E', 'L', 'L', 'O'}) tap(queue, letter_of_text);
  queue.key({.chord = {.key = Key::kBackspace}, .action = Action::kPress});
  queue.key({.chord = {.key = Key::kBackspace}, .action = Action::kRelease});
  tap(queue, 'P');
  queue.key({.chord = {.key = letter('A'), .control = true}, .action = Action::kPress});
  const auto text = [](const FrameInput& input) {
    return std::string(input.characters.begin(), input.characters.end());
  };
  FrameInput input = queue.next_frame(true);
  EXPECT_EQ(text(input), "HELLO");
  ASSERT_FALSE(input.keys.empty());
  EXPECT_EQ(input.keys.back().chord.key, Key::kBackspace);
  EXPECT_EQ(input.keys.back().action, Action::kPress);
  for (std::size_t i = 0; i + 1 < input.keys.size(); ++i) {
    EXPECT_EQ(input.keys[i].action, Action::kRelease) << "letters are characters alone";
  }
  input = queue.next_frame(true);
  EXPECT_EQ(text(input), "P");
  input = queue.next_frame(true);
  EXPECT_EQ(text(input), "") << "ImGui takes no characters beside Control";
  ASSERT_FALSE(input.keys.empty());
  EXPECT_EQ(input.keys.back().chord, (Chord{.key = letter('A'), .control = true}));
  EXPECT_FALSE(input.has_more);
}

TEST(InputQueue, AShortcutsReleaseArrivesEvenIfControlWasLetGoFirst) {
  InputQueue queue;
  queue.key({.chord = {.key = letter('V'), .control = true}, .action = Action::kPress});
  key(queue, 'V', Action::kRelease);
  EXPECT_EQ(queue.next_frame(true).keys.size(), 1u);
  const FrameInput input = queue.next_frame(true);
  ASSERT_EQ(input.keys.size(), 1u);
  EXPECT_EQ(input.keys[0].action, Action::kRelease);
}

TEST(InputQueue, RepeatsDoNotPileUpWhileFramesAreSlow) {
  InputQueue queue;
  key(queue, 'R', Action::kPress);
  for (int i = 0; i < 30; ++i) key(queue, 'R', Action::kRepeat);
  key(queue, 'R', Action::kRelease);
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"R+ ", "R* ", "R- "}));
  key(queue, 'R', Action::kPress);
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"R+ "}));
  key(queue, 'R', Action::kRepeat);
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"R* "}));
  key(queue, 'R', Action::kRepeat);
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"R* "}));
}

TEST(InputQueue, WhatIsHeldCountsAsReleasedWhenTheWindowLosesTheKeyboard) {
  InputQueue queue;
  key(queue, 'R', Action::kPress);
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"R+ "}));
  queue.release_all();
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"R- "}));
  // The backend's own release comes later and changes nothing.
  key(queue, 'R', Action::kRelease);
  EXPECT_TRUE(queue.empty());
  queue.release_all();
  EXPECT_TRUE(queue.empty());
}

TEST(InputQueue, AClickBetweenTwoFramesIsSeenWhereItWasMade) {
  InputQueue queue;
  queue.mouse_moved(1, 1);
  queue.mouse_moved(10, 20);
  queue.mouse_button(true);
  queue.mouse_button(false);
  queue.mouse_moved(500, 600);
  FrameInput input = queue.next_frame();
  EXPECT_TRUE(input.mouse.down);
  EXPECT_EQ(input.mouse.x, 10);
  EXPECT_TRUE(input.has_more);
  input = queue.next_frame();
  EXPECT_FALSE(input.mouse.down);
  EXPECT_EQ(input.mouse.y, 20);
  input = queue.next_frame();
  EXPECT_EQ(input.mouse.x, 500);
  EXPECT_FALSE(input.has_more);
}

TEST(InputQueue, AClickAndAKeyDoNotShareAFrame) {
  InputQueue queue;
  queue.mouse_button(true);
  key(queue, 'Y', Action::kPress);
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"", "Y+ "}));
  key(queue, 'N', Action::kPress);
  queue.mouse_button(false);
  EXPECT_EQ(frames(queue), (std::vector<std::string>{"N+ ", ""}));
}

TEST(InputQueue, StepsOfTheWheelAddUp) {
  InputQueue queue;
  queue.wheel(1);
  queue.wheel(1.5f);
  EXPECT_EQ(queue.next_frame().wheel, 2.5f);
  EXPECT_EQ(queue.next_frame().wheel, 0.0f);
}

TEST(Chord, IsPrintedAsOnTheKeys) {
  EXPECT_EQ(words({.key = letter('Z'), .control = true}), "Ctrl Z");
  EXPECT_EQ(words({.key = letter('Z'), .control = true, .shift = true}), "Ctrl Shift Z");
  EXPECT_EQ(words({.key = Key::kEscape}), "Esc");
  EXPECT_EQ(words({.key = Key::kUp}), "↑");
  EXPECT_EQ(words({.key = Key::kF12}), "F12");
  EXPECT_EQ(words({.key = Key::kPlus, .control = true}), "Ctrl +");
  EXPECT_EQ(words(Chord{}), "");
}

TEST(Chord, ShiftHeldByChanceStillMeansTheLetterButNotBesideControl) {
  const Chord y = {.key = letter('Y')};
  EXPECT_TRUE(answers(y, y));
  EXPECT_TRUE(answers({.key = letter('Y'), .shift = true}, y));
  EXPECT_FALSE(answers({.key = letter('Y'), .control = true}, y));
  const Chord undo = {.key = letter('Z'), .control = true};
  EXPECT_FALSE(answers({.key = letter('Z'), .control = true, .shift = true}, undo));
  EXPECT_FALSE(answers({.key = Key::kTab, .shift = true}, {.key = Key::kTab}));
  const Chord larger = {.key = Key::kPlus, .control = true};
  EXPECT_TRUE(answers({.key = Key::kPlus, .control = true, .shift = true}, larger));
  EXPECT_FALSE(answers({}, {}));
}

}  // namespace input_queue_test
}  // namespace jnd::app::gui
