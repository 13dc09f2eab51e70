#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "support/files.h"
#include "support/places.h"

namespace jnd::app {
namespace manual_test {

namespace fs = std::filesystem;

class ManualTest : public CommandTest {
 protected:
  /// Installs a manual of the test's own, whatever else this machine has.
  void SetUp() override {
    for (const char* page : {"docs/README.md", "docs/how-to/run_a_session.md", "SAFETY.md"}) {
      fs::create_directories(page_file(page).parent_path());
      test_support::write_file(page_file(page), "x");
    }
    options_.environment = {{"JND_SHARE", path("share/jnd").string()}};
  }
  [[nodiscard]] fs::path page_file(const std::string& page) const {
    return path("share/doc/jnd") / page;
  }
};

TEST_F(ManualTest, TellsWhereAPageIs) {
  EXPECT_EQ(jnd({"manual"}).out, page_file("docs/README.md").string() + "\n");
  EXPECT_EQ(jnd({"manual", "run_a_session"}).out,
            page_file("docs/how-to/run_a_session.md").string() + "\n");
  const auto told = document(jnd({"manual", "safety", "--json"}).out);
  EXPECT_EQ(told["page"], "SAFETY.md");
  EXPECT_EQ(told["place"], page_file("SAFETY.md").string());
  EXPECT_EQ(told["is_site"], false);
}

TEST_F(ManualTest, ListsItsPages) {
  EXPECT_EQ(jnd({"manual", "--list"}).out,
            "SAFETY.md\ndocs/README.md\ndocs/how-to/run_a_session.md\n");
}

TEST_F(ManualTest, APageThatIsNoneIsRefusedWithTheNearest) {
  const auto outcome = jnd({"manual", "run_a_sesion"});
  EXPECT_EQ(outcome.exit_code, 2);
  EXPECT_EQ(outcome.err,
            "jnd: manual: expected the name of a page, found `run_a_sesion`; did you mean "
            "`run_a_session`?\n");
  EXPECT_NE(jnd({"manual", "savety"}).err.find("`safety`?"), std::string::npos);
  EXPECT_NE(jnd({"manual", "zzzzzzzz"}).err.find("jnd manual --list"), std::string::npos);
}

TEST_F(ManualTest, WithoutAManualItSaysWhatToDo) {
  fs::remove_all(path("share/doc"));
  const auto outcome = jnd({"manual"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find("install the package"), std::string::npos) << outcome.err;
}

TEST_F(ManualTest, OpensAPageAndTellsItsPlaceWhereNothingOpensFiles) {
  const fs::path program = path("bin/xdg-open");
  fs::create_directories(program.parent_path());
  test_support::write_file(program, "#!/bin/sh\nprintf '%s' \"$1\" >'" + path("new").string() +
                                        "'\nmv '" + path("new").string() + "' '" +
                                        path("opened").string() + "'\n");
  ::chmod(program.c_str(), 0755);
  options_.environment.emplace_back("PATH", path("bin").string() + ":" + std::getenv("PATH"));
  EXPECT_EQ(jnd({"manual", "safety", "--open"}).exit_code, 0);
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!fs::exists(path("opened")) && std::chrono::steady_clock::now() < patience) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(test_support::read_file(path("opened")), page_file("SAFETY.md").string());

  fs::create_directory(path("empty"));
  fs::create_symlink("/bin/sh", path("empty") / "sh");
  options_.environment.back().second = path("empty").string();
  const auto outcome = jnd({"manual", "safety", "--open"});
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_NE(outcome.err.find(page_file("SAFETY.md").string()), std::string::npos);
}

}  // namespace manual_test
}  // namespace jnd::app
