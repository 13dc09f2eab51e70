#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "support/places.h"

namespace jnd::app {
namespace installation_test {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Runs the program as `cmake --install` puts it below any folder. It is installed once for all
/// tests of this file.
class InstallationTest : public CommandTest {
 protected:
  static void SetUpTestSuite() {
    installed_ = new test_support::TemporaryFolder(test_support::memory_folder());
    const auto outcome = test_support::run_program(
        {"--install", test_support::program_file().parent_path().string(), "--prefix",
         prefix().string(), "--strip"},
        {.folder = {}, .environment = {}, .program = "cmake"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static void TearDownTestSuite() {
    delete installed_;
    installed_ = nullptr;
  }
  static fs::path prefix() { return installed_->path() / "a folder"; }

  [[nodiscard]] test_support::ProgramOutcome installed(
      const std::vector<std::string>& words) const {
    return test_support::run_program(words, {.folder = temporary_.path(),
                                             .environment = {},
                                             .program = (prefix() / "bin/jnd").string()});
  }

  static test_support::TemporaryFolder* installed_;
};

test_support::TemporaryFolder* InstallationTest::installed_ = nullptr;

TEST_F(InstallationTest, ItsOwnStudiesAndDataAreUsedWhereverItIs) {
  // The source tree from which the program was built has no such study.
  fs::copy_file(prefix() / "share/jnd/protocols/short_tour.json",
                prefix() / "share/jnd/protocols/only_installed.json");
  EXPECT_EQ(installed({"validate", "only_installed"}).exit_code, 0);
  EXPECT_NE(jnd({"validate", "only_installed"}).exit_code, 0);
  const auto session = installed({"run", "short_tour", "--study", "a.study", "--participant",
                                  "P01", "--headless", "--laboratory", "thesis"});
  EXPECT_EQ(session.exit_code, 0) << session.err;
  EXPECT_EQ(installed({"verify", "a.study"}).exit_code, 0);
}

TEST_F(InstallationTest, DriversAreFoundAndRunInTheirOwnProgram) {
  const auto devices = installed({"devices"});
  EXPECT_NE(devices.out.find("force_dimension"), std::string::npos) << devices.out;
  EXPECT_TRUE(fs::exists(prefix() / "libexec/jnd/jnd-device-host"));
  // The maker's library is missing here, and the driver says so from its own process.
  const auto described = installed({"devices", "--device", "plugin:force_dimension"});
  EXPECT_EQ(described.err.find("jnd-device-host, in which"), std::string::npos)
      << described.err;
}

TEST_F(InstallationTest, ManualCompletionsIconsAndHeaderAreThere) {
  for (const char* file :
       {"share/man/man1/jnd.1", "share/man/man1/jnd-run.1", "share/man/man1/jnd-fit-weber.1",
        "share/bash-completion/completions/jnd", "share/zsh/site-functions/_jnd",
        "share/fish/vendor_completions.d/jnd.fish", "share/applications/jnd.desktop",
        "share/icons/hicolor/scalable/apps/jnd.svg", "share/icons/hicolor/48x48/apps/jnd.png",
        "include/jnd_device.h", "share/jnd/devices/example_device.c",
        "share/jnd/data/system/60-jnd.rules", "share/jnd/data/system/jnd.limits.conf",
        "share/doc/jnd/README.md", "share/doc/jnd/docs/README.md", "share/doc/jnd/LICENSE"}) {
    EXPECT_GT(fs::file_size(prefix() / file), 100u) << file;
    EXPECT_EQ(fs::status(prefix() / file).permissions() & fs::perms::others_read,
              fs::perms::others_read)
        << file;
  }
  EXPECT_NE(text_of(prefix() / "share/bash-completion/completions/jnd").find("short_tour"),
            std::string::npos);
}

// Documents may refer to one another, to pictures and to data. Links to files that exist only
// in the source would lead nowhere, because these are not installed.
TEST_F(InstallationTest, LinksOfTheDocumentsLeadSomewhere) {
  static const std::regex kLink(R"re(\]\(([^)#:]+)(#[^)]*)?\))re");
  const fs::path folder = prefix() / "share/doc/jnd";
  int num_links = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".md") continue;
    const std::string text = text_of(entry.path());
    for (std::sregex_iterator match(text.begin(), text.end(), kLink), end; match != end;
         ++match) {
      const std::string target = (*match)[1];
      if (target.find("tests/") != std::string::npos) continue;
      ++num_links;
      EXPECT_TRUE(fs::exists(entry.path().parent_path() / target))
          << entry.path() << ": " << target;
    }
  }
  EXPECT_GT(num_links, 100);
}

TEST_F(InstallationTest, NothingOfTheSystemIsWrittenButBelowThePrefix) {
  EXPECT_FALSE(fs::exists(prefix() / "etc"));
  EXPECT_FALSE(fs::exists(prefix() / "lib/udev"));
}

}  // namespace installation_test
}  // namespace jnd::app
