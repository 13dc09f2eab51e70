#include "experiments/protocol/located_json.h"

#include <gtest/gtest.h>

namespace jnd::experiments {
namespace located_json_test {

/// Returns the problems of a text, one in each line.
std::string problems_in(const std::string& text) {
  std::vector<StudyProblem> problems;
  const LocatedJson file(text, "x", problems);
  std::string lines;
  for (const StudyProblem& problem : problems) {
    lines += (lines.empty() ? "" : "\n") + to_string(problem);
  }
  return lines;
}

TEST(LocatedJson, KnowsWhereEveryValueAndKeyStands) {
  std::vector<StudyProblem> problems;
  const LocatedJson file("{\"a\": [1,\n  {\"b\" : \"x\"}],\n\"c\":true}", "x", problems);
  ASSERT_TRUE(file.usable());
  const auto value = [&](const char* pointer) {
    const TextPosition at = file.value_position(pointer);
    return std::pair(at.line, at.column);
  };
  const auto key = [&](const char* pointer) {
    const TextPosition at = file.key_position(pointer);
    return std::pair(at.line, at.column);
  };
  EXPECT_EQ(value(""), std::pair(1, 1));
  EXPECT_EQ(value("/a"), std::pair(1, 7));
  EXPECT_EQ(value("/a/0"), std::pair(1, 8));
  EXPECT_EQ(value("/a/1"), std::pair(2, 3));
  EXPECT_EQ(key("/a/1/b"), std::pair(2, 4));
  EXPECT_EQ(value("/a/1/b"), std::pair(2, 10));
  EXPECT_EQ(key("/c"), std::pair(3, 1));
  EXPECT_EQ(value("/c"), std::pair(3, 5));
}

TEST(LocatedJson, PlacesWhatIsMissingAtWhatEnclosesIt) {
  std::vector<StudyProblem> problems;
  const LocatedJson file("{\n\"a\": {}}", "x", problems);
  EXPECT_EQ(file.value_position("/a/b/c").line, 2);
  EXPECT_EQ(file.value_position("/a/b/c").column, 6);
  EXPECT_EQ(file.key_position("/b").line, 1);
}

TEST(LocatedJson, CountsCharactersAndNotBytes) {
  std::vector<StudyProblem> problems;
  const LocatedJson file(R"({"ä": "€ü", "b": 1})", "x", problems);
  EXPECT_EQ(file.value_position("/b").column, 18);
}

TEST(LocatedJson, IsNotMisledByEscapedQuotesAndBracketsInTexts) {
  std::vector<StudyProblem> problems;
  const LocatedJson file(R"({"a": "\"}], \\", "b/~": [[], {}]})", "x", problems);
  ASSERT_TRUE(file.usable());
  EXPECT_EQ(file.value_position("/b~1~0").column, 26);
  EXPECT_EQ(file.value_position("/b~1~0/1").column, 31);
}

TEST(LocatedJson, ReportsAKeyThatStandsTwice) {
  EXPECT_EQ(problems_in("{\"a\": 1,\n \"\\u0061\": 2}"),
            "x:2:2: /a: expected each key once, found this one a second time");
}

TEST(LocatedJson, SaysWhatIsWrongWithTheSyntaxAndWhere) {
  EXPECT_EQ(problems_in(""), "x:1:1: /: expected a value, found the end of the file");
  EXPECT_EQ(problems_in("{\"a\": [1,\n]}"),
            "x:2:1: /a/1: expected a value, found `]` (is there a comma too many?)");
  EXPECT_EQ(problems_in("{\"a\": 1,}"),
            "x:1:9: /: expected a key in quotes, found `}` (is there a comma too many?)");
  EXPECT_EQ(
      problems_in("{\"a\": 1 \"b\": 2}"),
      "x:1:8: /a: expected `,` behind this value, before the key `b`, found none; write it "
      "here");
  EXPECT_EQ(problems_in("{\"a\": 'x'}"),
            "x:1:7: /a: expected a value or a text in double quotes, found `'x'`");
  EXPECT_EQ(
      problems_in("{\"a\": 1} // b"),
      "x:1:10: /: expected the end of the file, found `//` (notes go into a key `comment`)");
}

TEST(LocatedJson, SaysWhatBelongsThereAndGuessesWhatWasMeant) {
  EXPECT_EQ(problems_in("{a: 1}"), "x:1:2: /: expected a key in double quotes, found `a`");
  EXPECT_EQ(problems_in("{\"a\": {\"b\": 1,\nc: 2}}"),
            "x:2:1: /a: expected a key in double quotes, found `c`");
  EXPECT_EQ(problems_in("{\"a\" b}"), "x:1:6: /a: expected `:`, found `b`");
  EXPECT_EQ(problems_in("{\"a\": 60 s}"), "x:1:10: /a: expected `,` or `}`, found `s`");
  EXPECT_EQ(problems_in("[60 s]"), "x:1:5: /1: expected `,` or `]`, found `s`");
  EXPECT_EQ(
      problems_in("{\"a\": \"b, \"c\": 1}"),
      "x:1:12: /a: expected `,` or `}`, found `c` (does the text before it lack a quote?)");
  EXPECT_EQ(problems_in("{\"a\": 60,5}"),
            "x:1:10: /: expected a key in quotes, found a number (decimals have a point, not a "
            "comma)");
  EXPECT_EQ(
      problems_in("[007]"),
      "x:1:3: /1: expected `,` or `]`, found a number (a number begins with 0 only before "
      "a point)");
  EXPECT_EQ(
      problems_in("[True]"),
      "x:1:2: /0: expected a value or a text in double quotes, found `True`; did you mean "
      "`true`?");
  EXPECT_EQ(problems_in("[\xE2\x80\x9Eno\xE2\x80\x9C]"),
            "x:1:2: /0: expected a value or a text in double quotes, found "
            "`\xE2\x80\x9Eno\xE2\x80\x9C` (write the straight quotes of the keyboard)");
}

TEST(LocatedJson, SaysWhereWhatIsNotClosedBegins) {
  EXPECT_EQ(problems_in("{\"a\": [1,\n {\"b\": 2],\n \"c\": 3}"),
            "x:2:9: /a/1/b: expected `,` or `}`, found `]`; the `{` in line 2, column 2 is not "
            "closed");
  EXPECT_EQ(problems_in("{\"a\": {\"b\": [\"}\", 2}}"),
            "x:1:20: /a/b/2: expected `,` or `]`, found `}`; the `[` in line 1, column 13 is "
            "not closed");
  EXPECT_EQ(problems_in("[[1, 2]"),
            "x:1:8: /1: expected `,` or `]`, found the end of the file; the `[` in line 1, "
            "column 1 is not closed");
}

TEST(LocatedJson, PlacesAMissingCommaBehindTheValueBefore) {
  EXPECT_EQ(problems_in("[0.5 0.75, 1]"),
            "x:1:5: /1: expected `,` or `]` behind this value, found a number");
  EXPECT_EQ(problems_in("[1 0e1]"),
            "x:1:3: /1: expected `,` or `]` behind this value, found a number");
  EXPECT_EQ(problems_in("[1 0]"),
            "x:1:3: /1: expected `,` or `]` behind this value, found a number");
  EXPECT_EQ(
      problems_in("[-060]"),
      "x:1:5: /1: expected `,` or `]`, found a number (a number begins with 0 only before "
      "a point)");
}

TEST(LocatedJson, NamesTheKeyThatLacksACommaBeforeIt) {
  EXPECT_EQ(problems_in("{\"a\": {\"en\": \"x\"}\n\n  \"b\\\"c\" : 1}"),
            "x:1:18: /a: expected `,` behind this value, before the key `b\\\"c` in line 3, "
            "found none; write it here");
  EXPECT_EQ(problems_in("{\"a\": \"x\" \"y\"}"),
            "x:1:10: /a: expected `,` or `}` behind this value, found a text in quotes")
      << "no key";
}

TEST(LocatedJson, NamesTheWordsOfJsonAsTheyAreWritten) {
  EXPECT_EQ(problems_in("[1 true]"),
            "x:1:3: /1: expected `,` or `]` behind this value, found `true`");
  EXPECT_EQ(problems_in("{\"a\": 1\nfalse}"),
            "x:1:8: /a: expected `,` or `}` behind this value, found `false`");
  EXPECT_EQ(problems_in("{null: 1}"), "x:1:5: /: expected a key in quotes, found `null`");
  EXPECT_EQ(problems_in("[1true]"), "x:1:6: /1: expected `,` or `]`, found `true`");
  EXPECT_EQ(problems_in("[true 1]"),
            "x:1:6: /1: expected `,` or `]` behind this value, found a number");
}

TEST(LocatedJson, KnowsNoNumbersThatAreNotFinite) {
  EXPECT_EQ(problems_in("{\"a\": [0, NaN]}"),
            "x:1:11: /a/1: expected a value or a text in double quotes, found `NaN`");
  EXPECT_EQ(problems_in("[-Infinity]"),
            "x:1:2: /0: expected a value or a text in double quotes, found `-Infinity`");
  EXPECT_EQ(problems_in("[1e999]"),
            "x:1:2: /0: expected a number that fits a double, found 1e999");
}

TEST(LocatedJson, RefusesBytesThatAreNotUtf8) {
  EXPECT_EQ(problems_in("{\"a\":\n \"b\xFF\"}"),
            "x:2:4: /a: expected UTF-8, found a byte that is not; save the file as UTF-8");
  EXPECT_EQ(problems_in("{\"a\": \"b\xC3"),
            "x:1:10: /a: expected UTF-8, found a byte that is not; save the file as UTF-8");
}

TEST(LocatedJson, RefusesBytesThatAreNotUtf8OutsideOfTextsToo) {
  EXPECT_EQ(problems_in("\xFF\xFE{\x01"),
            "x:1:1: /: expected UTF-8, found a byte that is not; save the file as UTF-8")
      << "as in UTF-16";
  EXPECT_EQ(problems_in("[a\x80\x1B[2J]"),
            "x:1:2: /0: expected a value or a text in double quotes, found `a\\x80\\u001B`");
}

TEST(LocatedJson, LooksBehindAZeroByte) {
  EXPECT_EQ(problems_in(std::string("{\"a\": 1}\n\0 junk", 15)),
            "x:2:1: /: expected text, found a zero byte; save the file as UTF-8");
}

TEST(LocatedJson, TakesNoWordsOfTheFileForThoseOfTheParser) {
  EXPECT_EQ(problems_in("{\"unexpected a; expected b ill-formed UTF-8\x01\": 1}"),
            "x:1:44: /: expected a text in quotes that is whole, found an error in it: control "
            "character U+0001 (SOH) must be escaped to \\u0001");
}

TEST(LocatedJson, TakesMemoryInProportionToTheText) {
  // A pointer for every value would take 2^40 bytes.
  std::string text = "{\"" + std::string(1 << 20, 'k') + "\": [0";
  for (int i = 1; i < 1 << 20; ++i) text += ",0";
  std::vector<StudyProblem> problems;
  const LocatedJson file(text + ", 1]}", "x", problems);
  ASSERT_TRUE(file.usable());
  EXPECT_EQ(file.value_position("/" + std::string(1 << 20, 'k') + "/1048576").column, 3145736);
}

TEST(LocatedJson, PointsAtTheSecondOfTwoEqualKeysWhoseValueCounts) {
  std::vector<StudyProblem> problems;
  const LocatedJson file("{\"a\": 1,\n\"b\": [{\"a\": 2, \"a\": 3}]}", "x", problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].pointer, "/b/0/a");
  EXPECT_EQ(problems[0].column, 16);
  EXPECT_EQ(file.value_position("/b/0/a").column, 21);
}

TEST(LocatedJson, TakesTheMarkThatSomeEditorsPutInFront) {
  std::vector<StudyProblem> problems;
  const LocatedJson file("\xEF\xBB\xBF{\"a\": 1}", "x", problems);
  EXPECT_TRUE(file.usable());
  EXPECT_EQ(file.value_position("/a").column, 7);
}

TEST(LocatedJson, RefusesBottomlessNestingWithoutRunningOutOfStack) {
  EXPECT_EQ(problems_in(std::string(32, '[') + std::string(32, ']')), "");
  EXPECT_EQ(problems_in(std::string(33, '[') + std::string(33, ']')),
            "x:1:33: /: expected at most 32 levels of brackets and braces, found more");
  EXPECT_NE(problems_in(std::string(1000000, '[')), "");
  EXPECT_EQ(problems_in("[\"" + std::string(100, '[') + "\"]"), "");
}

}  // namespace located_json_test
}  // namespace jnd::experiments
