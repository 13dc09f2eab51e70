#include <cstdlib>

#include "app/environment.h"
#include "app/window/window_fixture.h"
#include "app/window/window_studies.h"
#include "support/places.h"

namespace jnd::app {
namespace language_window_test {

namespace fs = std::filesystem;

/// Runs the window in a language whose every sentence is the English one in angle brackets.
class LanguageWindowTest : public WindowTest {
 protected:
  void SetUp() override {
    if (std::system("command -v msgen >/dev/null") != 0) {
      GTEST_SKIP() << "msgen is not installed (Debian's gettext)";
    }
    WindowTest::SetUp();
    if (IsSkipped()) return;
    const fs::path source = test_support::source_folder();
    window_->share = path("share");
    fs::create_directories(window_->share);
    for (const char* shared : {"protocols", "data"}) {
      fs::create_directory_symlink(source / shared, window_->share / shared);
    }
    const fs::path compiled = window_->share / "languages/xx/LC_MESSAGES/jnd.mo";
    fs::create_directories(compiled.parent_path());
    const std::string command =
        "msgen '" + (source / "data/languages/jnd.pot").string() +
        "' | msgfilter --keep-header sed 's/^\\(.*\\)$/«\\1»/'"
        " | sed 's/nplurals=INTEGER; plural=EXPRESSION/nplurals=2; plural=n != 1/'"
        " | msgfmt --output-file='" +
        compiled.string() + "' -";
    ASSERT_EQ(std::system(command.c_str()), 0);
  }

  static void expect_translated(const Screen& screen, const std::string& widget) {
    const Screen::Widget* found = screen.find(widget);
    ASSERT_NE(found, nullptr) << widget;
    EXPECT_TRUE(found->label.starts_with("«")) << widget << ": " << found->label;
  }
};

TEST_F(LanguageWindowTest, ATranslationOfTheCatalogueIsShownAndTheStudyKeepsItsWords) {
  const EnvironmentVariable locale("LC_ALL", nullptr), messages("LC_MESSAGES", nullptr);
  const EnvironmentVariable language("LANG", "xx_XX.UTF-8"), other("LANGUAGE", nullptr);
  prepare(study_of(kComparison));
  Screen now = window_->screen();
  for (const char* widget :
       {"begin", "emergency_stop", "leave", "pause", "apparatus", "keys"}) {
    expect_translated(now, widget);
  }
  EXPECT_TRUE(now.shows("«The loop runs and renders free space. Begin when you are ready.»"));
  window_->use("begin");
  window_->use("present");
  window_->wait_until("the test", [](const Screen& screen) {
    const Screen::Widget* present = screen.find("present");
    return present != nullptr && present->label == "«Present the test»";
  });
  window_->use("present");
  now = window_->wait_for("answer_yes");
  EXPECT_EQ(now.find("answer_yes")->label, "Thicker");
  EXPECT_TRUE(now.shows("«Trial 1 of 4»"));
  EXPECT_TRUE(now.shows("«felt for "));
  window_->use("answer_yes");
  window_->wait_for_text("«Trial 2 of 4»");
  window_->kill();
  EXPECT_EQ(responses(stored()), std::vector{1.0});
  for (const core::EventRow& event : stored().events(1)) {
    EXPECT_EQ(event.data.find("«"), std::string::npos) << event.data;
  }
}

TEST_F(LanguageWindowTest, IsChosenAtTheStartAndRememberedFromThenOn) {
  const EnvironmentVariable locale("LC_ALL", nullptr), messages("LC_MESSAGES", nullptr);
  const EnvironmentVariable language("LANG", "C.UTF-8"), other("LANGUAGE", nullptr);
  window_->start();
  EXPECT_EQ(window_->wait_for("new_study").find("new_study")->label, "New study");
  EXPECT_EQ(window_->wait_for("language").find("language")->label, "xx");
  window_->press("ctrl+d");
  window_->use("language");
  window_->wait_for_text("«New study»");
  EXPECT_EQ(window_->screen().find("language")->label, "English");
  EXPECT_TRUE(window_->is_dark()) << "the window is still the same";
  window_->press_close_button();
  EXPECT_EQ(window_->wait_for_exit().exit_code, 0);
  window_->start();
  window_->wait_for_text("«New study»");
  window_->use("language");
  window_->wait_until("English", [](const Screen& now) {
    return now.offers("new_study") && now.find("new_study")->label == "New study";
  });
  window_->press_close_button();
  EXPECT_EQ(window_->wait_for_exit().exit_code, 0);
}

}  // namespace language_window_test
}  // namespace jnd::app
