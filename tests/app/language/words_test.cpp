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

/// A language that nobody speaks: its words are English ones in capitals, and its plurals are
/// three, as in Polish.
constexpr const char* kPseudoLanguage = R"po(msgid ""
msgstr ""
"Language: xx\n"
"Content-Type: text/plain; charset=UTF-8\n"
"Content-Transfer-Encoding: 8bit\n"
"Plural-Forms: nplurals=3; plural=n==1 ? 0 : n<5 ? 1 : 2;\n"

msgid "Go on"
msgstr "GO ÖN"

msgid "Trial {} of {}"
msgstr "OF {1} TRIAL {0}"

msgid "Trial {} of about {}"
msgstr "TRIAL {:d} OF {nobody} {7}"

msgid "{} stroke"
msgid_plural "{} strokes"
msgstr[0] "{} STROKE"
msgstr[1] "{} STROKES"
msgstr[2] "{} OF STROKES"
)po";

/// A folder with that language as the program reads it.
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

  /// What `say` says in a process of its own, for a language is begun once.
  [[nodiscard]] std::string said(const Environment& environment,
                                 const std::function<std::string()>& say) const {
    int ends[2];
    if (::pipe(ends) != 0) return "no pipe";
    const pid_t child = ::fork();
    if (child == 0) {
      for (const char* name : {"LC_ALL", "LC_MESSAGES", "LANG", "LANGUAGE"}) ::unsetenv(name);
      for (const auto& [name, value] : environment) ::setenv(name.c_str(), value.c_str(), 1);
      begin_language(folder());
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
  // Its locale is on no machine, and most machines have no locale at all.
  EXPECT_EQ(said({{"LANG", "xx_XX.UTF-8"}}, say), translated);
  EXPECT_EQ(said({{"LC_ALL", "xx"}, {"LANG", "C.UTF-8"}}, say), translated);
  EXPECT_EQ(said({{"LANG", "C.UTF-8"}, {"LANGUAGE", "xx"}}, say), translated);
  EXPECT_EQ(said({{"LANG", "yy_YY.UTF-8"}, {"LANGUAGE", "yy:xx"}}, say), translated);
  EXPECT_EQ(said({{"LANGUAGE", "xx"}}, say), translated);
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
