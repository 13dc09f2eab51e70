#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>

#include "app/environment.h"
#include "app/gui/application/application.h"
#include "app/gui/views/every_view.h"
#include "app/gui/views/layout_problems.h"
#include "app/language/words.h"
#include "support/places.h"

// In German, and in a language whose sentences are all a third longer, nothing is cut and
// nothing overlaps, in the smallest window.

namespace jnd::app::gui {
namespace view_languages_test {

namespace fs = std::filesystem;

/// The parameter is "de", or "xx" for the pseudo-language.
class ViewLanguagesTest : public EverySessionTest,
                          public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    if (std::system("command -v msgfmt msgen >/dev/null") != 0) {
      GTEST_SKIP() << "msgfmt and msgen are not installed (Debian's gettext)";
    }
    const fs::path root = test_support::source_folder();
    const std::string language = GetParam();
    const fs::path compiled = languages_ / language / "LC_MESSAGES" / "jnd.mo";
    fs::create_directories(compiled.parent_path());
    const std::string made =
        language == "xx"
            ? "'" + (root / "app/language/pseudo_language.sh").string() + "'"
            : "cat '" + (root / "data/languages" / (language + ".po")).string() + "'";
    const std::string command = made + " | msgfmt --output-file='" + compiled.string() + "' -";
    ASSERT_EQ(std::system(command.c_str()), 0);
    ASSERT_TRUE(begin_language(languages_, language));
    ASSERT_EQ(spoken_language(), language);
  }
  void TearDown() override { (void)begin_language(languages_, "en"); }

  void look(const std::string& name, const Drawn& drawn) {
    ++num_seen_;
    const LayoutProblems problems(drawn, {0, 0, kLeastWidth, kLeastHeight});
    for (const std::string& problem : problems.sentences()) {
      if (told_.insert(problem).second) found_ += name + ": " + problem + "\n";
    }
  }
  void expect_no_problems() const { EXPECT_EQ(told_.size(), 0U) << found_; }

  const EnvironmentVariable language_{"LANGUAGE", nullptr};
  const fs::path languages_ = temporary_.path() / "languages";
  HeadlessUi ui_{kLeastWidth, kLeastHeight};
  EveryView every_{ui_,
                   [this](const std::string& name, const Drawn& drawn) { look(name, drawn); }};
  std::set<std::string> told_;
  std::string found_;
  int num_seen_ = 0;
};

TEST_P(ViewLanguagesTest, HasRoomOutsideOfSessions) {
  every_.start();
  every_.study();
  every_.overview();
  every_.record();
  every_.controls();
  every_.sessions();
  every_.results();
  every_.data();
  every_.device();
  every_.preparation();
  EXPECT_GT(num_seen_, 70);
  expect_no_problems();
}

TEST_P(ViewLanguagesTest, HasRoomInSessions) {
  every_.session_dialogs();
  for_each_state(
      [this](const std::string& name, const SessionView& view) { every_.session(name, view); });
  EXPECT_GT(num_seen_, 90);
  expect_no_problems();
}

TEST_P(ViewLanguagesTest, HasRoomForWhatStandsOnEveryView) {
  const EnvironmentVariable state("XDG_STATE_HOME", temporary_.path().c_str());
  Application application({}, [] {});
  application.offer({{"de", "Deutsch"}, {"en", "English"}});
  const auto draw = [&](Ui& ui) { application.draw(ui); };
  ui_.frame(draw);
  look("application, start", ui_.frame(draw));
  ui_.press(Key::kF1);
  ui_.frame(draw);
  look("application, keys", ui_.frame(draw));
  expect_no_problems();
}

INSTANTIATE_TEST_SUITE_P(Smallest, ViewLanguagesTest, ::testing::Values("de", "xx"),
                         [](const auto& instance) { return std::string(instance.param); });

}  // namespace view_languages_test
}  // namespace jnd::app::gui
