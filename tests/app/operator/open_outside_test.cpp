#include "app/operator/open_outside.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "support/files.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace open_outside_test {

namespace fs = std::filesystem;

/// Makes a desktop of the test's own, whose xdg-open notes what it was given.
class OpenOutsideTest : public ::testing::Test {
 protected:
  OpenOutsideTest() : path_(std::getenv("PATH")) {}
  ~OpenOutsideTest() override { ::setenv("PATH", path_.c_str(), 1); }

  void install() {
    const fs::path program = temporary_.path() / "xdg-open";
    test_support::write_file(program, "#!/bin/sh\nprintf '%s' \"$1\" > '" +
                                          (temporary_.path() / "opened.tmp").string() +
                                          "'\nmv '" +
                                          (temporary_.path() / "opened.tmp").string() + "' '" +
                                          opened().string() + "'\n");
    ::chmod(program.c_str(), 0755);
    ::setenv("PATH", (temporary_.path().string() + ":" + path_).c_str(), 1);
  }
  [[nodiscard]] fs::path opened() const { return temporary_.path() / "opened"; }

  std::string path_;
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

TEST_F(OpenOutsideTest, TheDesktopsProgramGetsTheWholePathAndNobodyWaits) {
  install();
  const fs::path report = temporary_.path() / "it's a report; rm -rf.html";
  test_support::write_file(report, "x");
  EXPECT_EQ(open_outside(report), "");
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!fs::exists(opened()) && std::chrono::steady_clock::now() < patience) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(test_support::read_file(opened()), report.string());
}

TEST_F(OpenOutsideTest, WhatIsGoneIsTold) {
  install();
  const fs::path gone = temporary_.path() / "gone";
  EXPECT_EQ(open_outside(gone), gone.string() + " is not there any more.");
  EXPECT_FALSE(fs::exists(opened()));
}

TEST_F(OpenOutsideTest, WithoutSuchAProgramItSaysWhereTheFileIs) {
  // This folder contains a shell and nothing else.
  fs::create_directory(temporary_.path() / "bin");
  fs::create_symlink("/bin/sh", temporary_.path() / "bin" / "sh");
  ::setenv("PATH", (temporary_.path() / "bin").c_str(), 1);
  const std::string problem = open_outside(temporary_.path());
  EXPECT_NE(problem.find("xdg-open"), std::string::npos) << problem;
  EXPECT_NE(problem.find(temporary_.path().string()), std::string::npos) << problem;
}

TEST_F(OpenOutsideTest, WhatTheDesktopHasNoProgramForIsToldWithItsPath) {
  const fs::path program = temporary_.path() / "xdg-open";
  test_support::write_file(program, "#!/bin/sh\nexit 3\n");
  ::chmod(program.c_str(), 0755);
  ::setenv("PATH", (temporary_.path().string() + ":" + path_).c_str(), 1);
  const fs::path page = temporary_.path() / "page.html";
  test_support::write_file(page, "x");
  const std::string problem = open_outside(page);
  EXPECT_NE(problem.find("Nothing on this desktop opens"), std::string::npos) << problem;
  EXPECT_NE(problem.find(page.string()), std::string::npos) << problem;
}

TEST_F(OpenOutsideTest, NobodyWaitsForAProgramThatStays) {
  const fs::path program = temporary_.path() / "xdg-open";
  test_support::write_file(program, "#!/bin/sh\nexec sleep 20\n");
  ::chmod(program.c_str(), 0755);
  ::setenv("PATH", (temporary_.path().string() + ":" + path_).c_str(), 1);
  const auto began = std::chrono::steady_clock::now();
  EXPECT_EQ(open_outside(temporary_.path()), "");
  EXPECT_LT(std::chrono::steady_clock::now() - began, std::chrono::seconds(10));
}

}  // namespace open_outside_test
}  // namespace jnd::app
