#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "support/files.h"
#include "support/places.h"

namespace window_words_test {

namespace fs = std::filesystem;

// The folders in which the window's words are made. There, every sentence goes through `tr` or
// a similar function (app/language/words.h). Otherwise a translator would never see it.
const std::vector<std::string> kFolders = {"app/gui", "app/operator"};

// Files, as beginnings of paths, that show no words of their own or are not translated yet,
// with the reason.
const std::map<std::string, std::string> kWithout = {
    {"app/gui/frame_times.", "a log for tests, and what is said on the terminal of it"},
    {"app/gui/hand_sign.", "names of signs, for the log of tests"},
    {"app/gui/robot_scene.", "XML for the model of the apparatus"},
    {"app/gui/theme_fonts.", "names of files"},
    {"app/gui/widget_log.", "a log for tests"},
    {"app/gui/window_opening.", "said on the terminal, for there is no window"},
    {"app/gui/application/open_window.", "said on the terminal, for there is no window"},
};

// Whole literals that look like words for people and are none.
const std::vector<std::regex> kNoWords = {
    std::regex(R"(((Ctrl|Shift|Esc|Enter|F\d+|[A-Z+-]) *)+)"),  // Names of keys.
    std::regex("jnd"),               // This is the name of the program.
    std::regex(R"(N m|\{:g\} Hz)"),  // These are units.
    std::regex("Software"),          // OpenGL names a renderer so.
};

const std::set<std::string> kMarks = {"tr", "trn", "tr_later", "as_is"};
/// What is passed to these functions is drawn, even if it is a single short word.
const std::set<std::string> kDrawing = {"text",    "heading",     "chip",
                                        "tooltip", "draw_notice", "draw_card"};

struct Token {
  std::string text;
  int line = 0;
  [[nodiscard]] bool is_literal() const {
    return text.front() == '"' || text.starts_with("R\"");
  }
};

/// Returns the tokens without comments and preprocessor lines. Neighbouring literals are one
/// token.
std::vector<Token> tokens_of(const std::string& source) {
  static const std::regex kToken(
      R"re(//[^\n]*|/\*[^]*?\*/|#[^\n]*|R"\(([^]*?)\)"|R"(\w+)\([^]*?\)\2"|"(\\.|[^"\\\n])*"|'(\\.|[^'\\\n])+'|[A-Za-z_]\w*|\d[\w'.]*|\s+|.)re");
  std::vector<Token> tokens;
  int line = 1;
  for (std::sregex_iterator at(source.begin(), source.end(), kToken), end; at != end; ++at) {
    const std::string text = at->str();
    const bool is_code = !std::isspace(static_cast<unsigned char>(text.front())) &&
                         text.front() != '#' && !text.starts_with("//") &&
                         !text.starts_with("/*");
    if (is_code) {
      const Token token{text, line};
      if (token.is_literal() && !tokens.empty() && tokens.back().is_literal()) {
        tokens.back().text.pop_back();
        tokens.back().text += text.substr(1);
      } else {
        tokens.push_back(token);
      }
    }
    line += static_cast<int>(std::ranges::count(text, '\n'));
  }
  return tokens;
}

/// Returns a literal without its quotes, its escapes, and what fmt ("{:.1f}") or printf fills
/// in.
std::string words_in(const std::string& literal) {
  static const std::regex kFilledIn(R"(\{[^}]*\}|%[-+ #0-9.*l]*[a-z])");
  static const std::regex kEscape(R"(\\.)");
  const std::string inside = literal.substr(1, literal.size() - 2);
  return std::regex_replace(std::regex_replace(inside, kEscape, " "), kFilledIn, " # ");
}

/// Returns whether people would read the literal: it has two words, one that begins with a
/// capital, or one beside a blank or a filled-in value. Names of controls and of files have
/// underscores or dots.
bool is_for_people(const std::string& literal) {
  static const std::regex kWord(R"([“(]*[A-Za-z][a-z]+([-'’][A-Za-z]+)*[,.:;?!…)”]*)");
  static const std::regex kTitle(R"([“(]*[A-Z][a-z]+.*)");
  const std::string words = words_in(literal);
  if (std::ranges::any_of(kNoWords, [&](const std::regex& allowed) {
        return std::regex_match(literal.substr(1, literal.size() - 2), allowed);
      })) {
    return false;
  }
  int num_words = 0;
  bool has_title = false;
  std::istringstream stream(words);
  for (std::string part; stream >> part;) {
    if (!std::regex_match(part, kWord)) continue;
    ++num_words;
    has_title |= std::regex_match(part, kTitle);
  }
  return num_words > 1 || (num_words == 1 && (has_title || words.find(' ') != words.npos));
}

struct Finding {
  int line = 0;
  std::string literal;
};

/// Returns the literals for people that no translator would see.
std::vector<Finding> unmarked(const std::string& source) {
  const std::vector<Token> tokens = tokens_of(source);
  std::vector<Finding> found;
  std::vector<std::string> calls;  // The open parentheses, each with the word before it.
  // Whether the literal before this one was marked, as the first one of trn is.
  bool is_marked = false;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const Token& token = tokens[i];
    if (token.text == "(") calls.push_back(i > 0 ? tokens[i - 1].text : "");
    if (token.text == ")" && !calls.empty()) calls.pop_back();
    if (!token.is_literal()) {
      is_marked = is_marked && token.text == ",";
      continue;
    }
    const bool is_first = i > 0 && tokens[i - 1].text == "(";
    const std::string call = calls.empty() ? "" : calls.back();
    const bool was_marked = std::exchange(is_marked, is_first && kMarks.contains(call));
    if (is_marked || (was_marked && call == "trn")) continue;
    static const std::regex kLetters(R"(.*[A-Za-z]{2}.*)");
    const bool is_drawn = kDrawing.contains(call) && !is_first &&
                          std::regex_match(words_in(token.text), kLetters) &&
                          token.text != "\"jnd\"";
    if (is_drawn || is_for_people(token.text)) found.push_back({token.line, token.text});
  }
  return found;
}

TEST(WindowWords, EverySentenceOfTheWindowIsInTheCatalogue) {
  const fs::path root = jnd::test_support::source_folder();
  int num_files = 0;
  for (const std::string& folder : kFolders) {
    for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
      const fs::path kind = entry.path().extension();
      const std::string file = fs::relative(entry.path(), root).generic_string();
      if ((kind != ".h" && kind != ".cpp") ||
          std::ranges::any_of(kWithout,
                              [&](const auto& row) { return file.starts_with(row.first); })) {
        continue;
      }
      ++num_files;
      for (const Finding& finding : unmarked(jnd::test_support::read_file(entry.path()))) {
        ADD_FAILURE() << file << ':' << finding.line << ": " << finding.literal
                      << " has to be in tr(...), or in as_is(...) where it goes into a study "
                         "and is no word of the window";
      }
    }
  }
  EXPECT_GT(num_files, 100);
}

TEST(WindowWords, AFileThatIsLeftOutIsThere) {
  const fs::path root = jnd::test_support::source_folder();
  for (const auto& [beginning, why] : kWithout) {
    const fs::path whole = root / beginning;
    EXPECT_TRUE(std::ranges::any_of(fs::directory_iterator(whole.parent_path()),
                                    [&](const auto& entry) {
                                      return entry.path().filename().string().starts_with(
                                          whole.filename().string());
                                    }))
        << beginning << " (" << why << ") is not there";
  }
}

TEST(WindowWords, WhatPeopleReadIsToldFromNames) {
  for (const char* words :
       {R"("Go on")", R"("Cancel")", R"("{} free")", R"(" at ")", R"("came off: {}")",
        R"("the quantity's range")", R"("Looking …")", R"("“New session”")"}) {
    EXPECT_TRUE(is_for_people(words)) << words;
  }
  for (const char* no_words : {R"("emergency_stop")", R"("study.sqlite")", R"("%.1f s")",
                               R"("Ctrl D")", R"("N m")", R"(" · ")", R"("yes")", R"("")"}) {
    EXPECT_FALSE(is_for_people(no_words)) << no_words;
  }
}

TEST(WindowWords, ALiteralIsFoundUnlessItIsTheFirstInAMark) {
  const auto lines = [](const std::string& source) {
    std::vector<int> found;
    for (const Finding& finding : unmarked(source)) found.push_back(finding.line);
    return found;
  };
  EXPECT_EQ(lines("a(tr(\"Go on\"));\nb(\"Go on\");"), std::vector{2});
  EXPECT_EQ(lines("trn(\"{} trial\",\n \"{} trials\", n);"), std::vector<int>{});
  EXPECT_EQ(lines("tr(\"in {}\",\n is_it ? \"the other\" : \"\");"), std::vector{2});
  EXPECT_EQ(lines("tr(\"two \"\n\"literals\");"), std::vector<int>{});
  EXPECT_EQ(lines("// \"not code\"\nui.text(place, \"small\");"), std::vector{2});
  EXPECT_EQ(lines("#include \"no words/of people\"\nid(\"a_name\");"), std::vector<int>{});
}

TEST(WindowWords, TheCatalogueIsWhatTheSourcesSay) {
  if (std::system("command -v xgettext >/dev/null") != 0) {
    GTEST_SKIP() << "xgettext is not installed (Debian's gettext)";
  }
  const fs::path root = jnd::test_support::source_folder();
  const std::string command =
      "'" + (root / "app/language/collect_words.sh").string() + "' 2>/dev/null";
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(::popen(command.c_str(), "r"), ::pclose);
  ASSERT_NE(pipe, nullptr);
  std::string collected;
  std::array<char, 4096> part{};
  for (std::size_t size = 0;
       (size = std::fread(part.data(), 1, part.size(), pipe.get())) > 0;) {
    collected.append(part.data(), size);
  }
  EXPECT_TRUE(collected == jnd::test_support::read_file(root / "data/languages/jnd.pot"))
      << "the window's words have changed: ./dev words writes data/languages/jnd.pot anew";
}

}  // namespace window_words_test
