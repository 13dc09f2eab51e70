#include "app/gui/text_layout.h"

#include <gtest/gtest.h>

namespace jnd::app::gui {
namespace text_layout_test {

using Lines = std::vector<std::string_view>;

/// Returns the width of a text whose every byte is one unit wide.
float length(std::string_view text) { return static_cast<float>(text.size()); }

TEST(TextLayout, BreaksAtSpacesAndLineEnds) {
  EXPECT_EQ(break_lines("one two three", 7, length, false), (Lines{"one two", "three"}));
  EXPECT_EQ(break_lines("one\ntwo three", 20, length, false), (Lines{"one", "two three"}));
  EXPECT_EQ(break_lines("one\n\ntwo", 20, length, false), (Lines{"one", "", "two"}));
  EXPECT_EQ(break_lines("", 20, length, false), (Lines{""}));
  EXPECT_EQ(break_lines("one", 3, length, false), (Lines{"one"}));
}

TEST(TextLayout, AWordThatIsTooWideIsBrokenAnywhereButNotWithinACharacter) {
  EXPECT_EQ(break_lines("abcdefgh ij", 3, length, false), (Lines{"abc", "def", "gh", "ij"}));
  EXPECT_EQ(break_lines("äöü", 3, length, false), (Lines{"ä", "ö", "ü"}));
  EXPECT_EQ(break_lines("äb", 0, length, false), (Lines{"ä", "b"}));
}

TEST(TextLayout, BalancedLinesAreAsManyAndOfAboutEqualLength) {
  const std::string_view text = "aaa bbb ccc ddd eee f";
  EXPECT_EQ(break_lines(text, 19, length, false), (Lines{"aaa bbb ccc ddd eee", "f"}));
  EXPECT_EQ(break_lines(text, 19, length, true), (Lines{"aaa bbb ccc", "ddd eee f"}));
}

TEST(TextLayout, LinesOfAnyWidthHoldTheWholeText) {
  const std::string text = "Move slowly  back and forth.\nStop at äußerste Punkte.";
  for (int width = 0; width < 60; ++width) {
    for (const bool balanced : {false, true}) {
      std::string joined;
      for (const auto line : break_lines(text, static_cast<float>(width), length, balanced)) {
        joined += line;
      }
      std::erase(joined, ' ');
      std::string expected = text;
      std::erase(expected, ' ');
      std::erase(expected, '\n');
      EXPECT_EQ(joined, expected) << width;
    }
  }
}

TEST(TextLayout, ShortensWithAnEllipsisOnlyWhereItMust) {
  EXPECT_EQ(shorten("Viscosity", 9, length), "Viscosity");
  EXPECT_EQ(shorten("Viscosity", 8, length), "Visco…");  // The ellipsis takes three bytes.
  EXPECT_EQ(shorten("to be or", 8 - 1, length), "to b…");
  EXPECT_EQ(shorten("to be or", 6, length), "to…");
  EXPECT_EQ(shorten("ääää", 6, length), "ä…");
  EXPECT_EQ(shorten("Viscosity", 0, length), "…");
}

TEST(TextLayout, CapitalsAreThoseOfEuropeanLanguagesAndLeaveGreekSymbolsAlone) {
  EXPECT_EQ(in_capitals("Session"), "SESSION");
  EXPECT_EQ(in_capitals("größte Übung"), "GRÖSSTE ÜBUNG");
  EXPECT_EQ(in_capitals("łódź, ÿ, ÷"), "ŁÓDŹ, Ÿ, ÷");
  EXPECT_EQ(in_capitals("η · q"), "η · Q");
}

TEST(TextLayout, AUnitIsNoWord) {
  EXPECT_EQ(in_capitals("5 µm · η"), "5 µm · η");
  EXPECT_EQ(in_capitals("Group D: 1.85 Pa s"), "GROUP D: 1.85 Pa s");
  EXPECT_EQ(in_capitals("Viscosity in Pa s"), "VISCOSITY IN Pa s");
  EXPECT_EQ(in_capitals("Stiffness [N/m], largest speed [m/s]"),
            "STIFFNESS [N/m], LARGEST SPEED [m/s]");
  EXPECT_EQ(in_capitals("10 mm, 2 s, 3 stimuli"), "10 mm, 2 s, 3 STIMULI");
  EXPECT_EQ(in_capitals("Spa sessions, m and s"), "SPA SESSIONS, M AND S");
  EXPECT_EQ(in_capitals("m/s"), "m/s");
}

}  // namespace text_layout_test
}  // namespace jnd::app::gui
