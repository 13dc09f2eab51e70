#include "experiments/study/shown_text.h"

#include <gtest/gtest.h>

namespace jnd::experiments {
namespace shown_text_test {

TEST(ShownText, LeavesOrdinaryWordsOfAnyLanguageAlone) {
  EXPECT_EQ(shown_text("Wasser"), "Wasser");
  EXPECT_EQ(shown_text("z\xC3\xA4h, \xE7\xB2\x98, \xF0\x9F\x8D\xAF"),
            "z\xC3\xA4h, \xE7\xB2\x98, \xF0\x9F\x8D\xAF");
  EXPECT_EQ(shown_text(""), "");
}

TEST(ShownText, WritesWhatATerminalWouldObeyAsJsonDoes) {
  EXPECT_EQ(shown_text("a\"b\\c\n\r\t"), R"(a\"b\\c\n\r\t)");
  EXPECT_EQ(shown_text(std::string_view("\0\x1B[2J\x7F", 6)), R"(\u0000\u001B[2J\u007F)");
  EXPECT_EQ(shown_text("\xC2\x9B"), R"(\u009B)");
  EXPECT_EQ(shown_text("\xE2\x80\xAE"), R"(\u202E)") << "turns the line around";
}

TEST(ShownText, WritesBytesThatAreNotUtf8AsTheirNumbers) {
  EXPECT_EQ(shown_text("gr\xFCn"), R"(gr\xFCn)") << "Latin-1";
  EXPECT_EQ(shown_text("\xC3"), R"(\xC3)") << "cut off";
  EXPECT_EQ(shown_text("\xC0\x80"), R"(\xC0\x80)") << "longer than need be";
  EXPECT_EQ(shown_text("\xED\xA0\x80"), R"(\xED\xA0\x80)") << "half of a pair";
  EXPECT_EQ(shown_text("\xF4\x90\x80\x80"), R"(\xF4\x90\x80\x80)") << "beyond Unicode";
  EXPECT_EQ(shown_text("\xFF\xFE"), R"(\xFF\xFE)");
}

TEST(ShownText, CutsLongTextsBetweenCharacters) {
  EXPECT_EQ(shown_text("abcd", 4), "abcd");
  EXPECT_EQ(shown_text("abcde", 4), "abcd...");
  EXPECT_EQ(shown_text("\xC3\xA4\xC3\xA4\xC3\xA4", 2), "\xC3\xA4\xC3\xA4...");
  EXPECT_EQ(shown_text(std::string(1000000, '\x80'), 8), R"(\x80\x80...)");
}

TEST(ShownText, KeepsShortPointersAndShortensEachLongKey) {
  EXPECT_EQ(shortened_pointer(""), "");
  EXPECT_EQ(shortened_pointer("/"), "/");
  EXPECT_EQ(shortened_pointer("/stages/0//a~1b"), "/stages/0//a~1b");
  const std::string shortened = shortened_pointer("/" + std::string(1000000, 'k') + "/0");
  EXPECT_EQ(shortened, "/" + std::string(59, 'k') + ".../0");
  EXPECT_EQ(shortened_pointer("/" + std::string(58, 'k') + "\xC3\xA4"),
            "/" + std::string(58, 'k') + "...");
}

}  // namespace shown_text_test
}  // namespace jnd::experiments
