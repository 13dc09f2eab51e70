#include "app/language/words.h"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace words_test {

namespace fs = std::filesystem;
using Environment = std::vector<std::pair<std::string, std::string>>;

/// An invented language: its words are English ones in capitals, and it has three plurals, as
/// Polish does.
constexpr const char* kPseudoLanguage = R"po(msgid ""
msgstr ""
"Language: xx\n"
"X-Language-Name: Ixisch\n"
"Content-Type: text/plain; charset=UTF-8\n"
"Content-Transfer-Encoding: 8bit\n"
"Plural-Forms: nplurals=3; plural=n==1 ? 0 : n<5 ? 1 : 2;\n"

msgid "Go on"
msgstr "GO ÖN"

msgid "Trial {} of {}"
msgstr "OF {1} TRIAL {0}"

msgid "Trial {} of about {}"
msgstr "TRIAL {:d} OF {nobody} {7}"

msgid "Ctrl"
msgstr "STRG"

msgid "{} stroke"
msgid_plural "{} strokes"
msgstr[0] "{} STROKE"
msgstr[1] "{} STROKES"
msgstr[2] "{} OF STROKES"
)po";

/// Makes a folder with that language, as the program reads it.
class WordsTest : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v msgfmt >/dev/null") != 0) {
      GTEST_SKIP() << "msgfmt is not installed (Debian's gettext)";
    }
    const fs::path source =
        test_support::write_file(temporary_.path() / "xx.po", kPseudoLanguage);
    const fs::path compiled = folder() / "xx" / "LC_MESSAGES" / "jnd.mo";
    fs::create_directories(compiled.parent_path());
    const std::string command =
        "msgfmt --output-file='" + compiled.string() + "' '" + source.string() + "'";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }

  [[nodiscard]] fs::path folder() const { return temporary_.path() / "languages"; }
  [[nodiscard]] fs::path temporary_path() const { return temporary_.path(); }

  /// Returns what `say` says in a process of its own, because a language is started only once
  /// in a process.
  [[nodiscard]] std::string said(const Environment& environment,
                                 const std::function<std::string()>& say,
                                 const std::string& chosen = "") const {
    int ends[2];
    if (::pipe(ends) != 0) return "no pipe";
    const pid_t child = ::fork();
    if (child == 0) {
      for (const char* name : {"LC_ALL", "LC_MESSAGES", "LC_NUMERIC", "LANG", "LANGUAGE"}) {
        ::unsetenv(name);
      }
      for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
      begin_language(folder(), chosen);
      const std::string words = say();
      const bool is_written =
          ::write(ends[1], words.data(), words.size()) == static_cast<ssize_t>(words.size());
      ::_exit(is_written ? 0 : 1);
    }
    ::close(ends[1]);
    std::string words(1000, '\0');
    const ssize_t size = ::read(ends[0], words.data(), words.size());
    ::close(ends[0]);
    ::waitpid(child, nullptr, 0);
    words.resize(size > 0 ? static_cast<std::size_t>(size) : 0);
    return words;
  }

 private:
  test_support::TemporaryFolder temporary_;
};

TEST(Words, WithoutALanguageStayAsTheyAreWritten) {
  const char* words = "Go on";
  EXPECT_EQ(tr(words), words);
  EXPECT_STREQ(tr(""), "");
  EXPECT_EQ(tr("Trial {} of {}", 3, 40), "Trial 3 of 40");
  EXPECT_EQ(tr("{:.1f} of {:g} N", 1.25, 20.0), "1.2 of 20 N");
  EXPECT_EQ(trn("{} stroke", "{} strokes", 1), "1 stroke");
  EXPECT_EQ(trn("{} stroke", "{} strokes", 0), "0 strokes");
  EXPECT_EQ(trn("{1}: {0} trial", "{1}: {0} trials", 2, "block"), "block: 2 trials");
}

TEST_F(WordsTest, ComeOutTranslated) {
  const auto say = [] {
    return std::string(tr("Go on")) + "; " + tr("Trial {} of {}", 3, 40) + "; " +
           trn("{} stroke", "{} strokes", 1) + "; " + trn("{} stroke", "{} strokes", 3) + "; " +
           trn("{} stroke", "{} strokes", 5);
  };
  const std::string translated = "GO ÖN; OF 40 TRIAL 3; 1 STROKE; 3 STROKES; 5 OF STROKES";
  // No machine has a locale of this language, and most machines have no locale at all.
  EXPECT_EQ(said({{"LANG", "xx_XX.UTF-8"}}, say), translated);
  EXPECT_EQ(said({{"LC_ALL", "xx"}, {"LANG", "C.UTF-8"}}, say), translated);
  EXPECT_EQ(said({{"LANG", "C.UTF-8"}, {"LANGUAGE", "xx"}}, say), translated);
  EXPECT_EQ(said({{"LANG", "yy_YY.UTF-8"}, {"LANGUAGE", "yy:xx"}}, say), translated);
  EXPECT_EQ(said({{"LANGUAGE", "xx"}}, say), translated);
  EXPECT_EQ(said({{"LANG", "xx_XX.UTF-8"}, {"LANGUAGE", ""}}, say), translated);
}

TEST_F(WordsTest, StayEnglishInAPlainLocaleAndInOneWithoutACatalogue) {
  const auto say = [] {
    return std::string(tr("Go on")) + ", " + std::setlocale(LC_MESSAGES, nullptr);
  };
  EXPECT_EQ(said({}, say), "Go on, C");
  EXPECT_EQ(said({{"LANG", "C"}, {"LANGUAGE", "xx"}}, say), "Go on, C");
  EXPECT_EQ(said({{"LANG", "C.UTF-8"}}, say), "Go on, C");
  EXPECT_EQ(said({{"LANG", "yy_YY.UTF-8"}}, say), "Go on, C");
}

TEST_F(WordsTest, WithoutATranslationAreEnglishAmongOthers) {
  const auto say = [] {
    return std::string(tr("Nobody has translated this")) + "; " + tr("") + "; " +
           trn("{} finger", "{} fingers", 2);
  };
  EXPECT_EQ(said({{"LANG", "xx"}}, say), "Nobody has translated this; ; 2 fingers");
}

TEST_F(WordsTest, WhoseHolesDoNotFitAreEnglish) {
  EXPECT_EQ(said({{"LANG", "xx"}}, [] { return tr("Trial {} of about {}", 3, 40); }),
            "Trial 3 of about 40");
}

TEST_F(WordsTest, AreOfTheLanguageThatSomebodyChoseWhateverTheLocaleSays) {
  const auto say = [] { return std::string(tr("Go on")) + ", " + spoken_language(); };
  EXPECT_EQ(said({}, say, "xx"), "GO ÖN, xx");
  EXPECT_EQ(said({{"LC_ALL", "C"}, {"LANGUAGE", "yy"}}, say, "xx"), "GO ÖN, xx");
  EXPECT_EQ(said({{"LANG", "xx_XX.UTF-8"}}, say, "en"), "Go on, en");
  EXPECT_EQ(said({{"LANG", "xx_XX.UTF-8"}}, say), "GO ÖN, xx");
  EXPECT_EQ(said({}, say, "yy"), "Go on, en") << "it has no catalogue";
}

TEST_F(WordsTest, ChangeAsOftenAsSomebodyChoosesAnotherLanguage) {
  const auto say = [this] {
    std::string words;
    for (const char* language : {"en", "xx", "xx", "en", "xx"}) {
      begin_language(folder(), language);
      words += std::string(tr("Go on")) + ", ";
    }
    return words;
  };
  const std::string changing = "Go on, GO ÖN, GO ÖN, Go on, GO ÖN, ";
  EXPECT_EQ(said({}, say), changing);
  EXPECT_EQ(said({{"LANG", "xx_XX.UTF-8"}}, say), changing);
}

TEST_F(WordsTest, LanguagesAreCalledAsTheirCataloguesSay) {
  const std::vector<Language> both = {{"en", "English"}, {"xx", "Ixisch"}};
  EXPECT_EQ(languages_in(folder()), both);
  const std::vector<Language> alone = {{"en", "English"}};
  EXPECT_EQ(languages_in(folder() / "nowhere"), alone);
  for (const std::string& wrong :
       {std::string(), std::string("no catalogue"), std::string("\xde\x12\x04\x95"),
        std::string("\xde\x12\x04\x95") + std::string(60, '\xff')}) {
    const fs::path file = folder() / "zz" / "LC_MESSAGES" / "jnd.mo";
    fs::create_directories(file.parent_path());
    test_support::write_file(file, wrong);
    EXPECT_EQ(languages_in(folder()), both) << wrong;
  }
}

/// The pseudo-language is installed by the name of a language that writes decimal commas, or of
/// one that does not.
TEST_F(WordsTest, OfALanguageWithDecimalCommasHaveThemUnderstood) {
  const auto says_comma = [this](const Environment& environment, const std::string& chosen) {
    return said(
        environment, [] { return writes_decimal_comma() ? "yes" : "no"; }, chosen);
  };
  std::string german = kPseudoLanguage;
  german.replace(german.find("Language: xx"), 12, "Language: de");
  const fs::path source = test_support::write_file(temporary_path() / "de.po", german);
  const fs::path compiled = folder() / "de" / "LC_MESSAGES" / "jnd.mo";
  fs::create_directories(compiled.parent_path());
  const std::string command =
      "msgfmt --output-file='" + compiled.string() + "' '" + source.string() + "'";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(says_comma({}, "de"), "yes");
  EXPECT_EQ(says_comma({{"LANG", "en_US.UTF-8"}}, "de"), "yes");
  EXPECT_EQ(says_comma({{"LANG", "de_DE.UTF-8"}}, ""), "yes");
  EXPECT_EQ(says_comma({{"LC_MESSAGES", "de_DE.UTF-8"}, {"LANG", "en_US.UTF-8"}}, ""), "yes");
  EXPECT_EQ(says_comma({{"LANG", "de_CH.UTF-8"}}, ""), "no") << "Switzerland has a point";
  EXPECT_EQ(says_comma({{"LANG", "de_CH.UTF-8"}}, "de"), "no");
  EXPECT_EQ(says_comma({{"LANG", "en_US.UTF-8"}}, "xx"), "no");
  EXPECT_EQ(says_comma({{"LANG", "de_DE.UTF-8"}}, "en"), "yes") << "numbers are the locale's";
  EXPECT_EQ(says_comma({}, "en"), "no");
}

TEST(Words, ThatAreNumbersHavePointsForTheirDecimalCommas) {
  EXPECT_EQ(with_decimal_points("0,5", true), "0.5");
  EXPECT_EQ(with_decimal_points("0,25; 0,5", true), "0.25; 0.5");
  EXPECT_EQ(with_decimal_points("0,25, 0,5", true), "0.25, 0.5");
  EXPECT_EQ(with_decimal_points("0.25,0.5", true), "0.25,0.5") << "commas are between numbers";
  EXPECT_EQ(with_decimal_points("0,5", false), "0,5");
  EXPECT_EQ(with_decimal_points(",5 1, 2 a,b", true), ",5 1, 2 a,b");
  EXPECT_EQ(with_decimal_points("", true), "");
}

TEST_F(WordsTest, LeaveNumbersAsTheyAre) {
  const auto say = [] {
    char number[32];
    std::snprintf(number, sizeof number, "%.1f", 1234.5);
    return std::string(number) + " " + std::setlocale(LC_NUMERIC, nullptr) + " " +
           std::setlocale(LC_TIME, nullptr);
  };
  EXPECT_EQ(said({{"LC_ALL", "xx_XX.UTF-8"}}, say), "1234.5 C C");
}

}  // namespace words_test
}  // namespace jnd::app
