#include "app/session/sleep_inhibitor.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "support/temporary_folder.h"

namespace jnd::app {
namespace sleep_inhibitor_test {

namespace fs = std::filesystem;

/// Puts a program of the test's own in the place of systemd-inhibit.
class SleepInhibitorTest : public ::testing::Test {
 protected:
  void SetUp() override { path_before_ = std::getenv("PATH"); }
  void TearDown() override { ::setenv("PATH", path_before_.c_str(), 1); }

  void install(const std::string& script) {
    const fs::path file = temporary.path() / "systemd-inhibit";
    std::ofstream(file) << "#!/bin/sh\n" << script;
    fs::permissions(file, fs::perms::owner_all);
    ::setenv("PATH", (temporary.path().string() + ":" + path_before_).c_str(), 1);
  }

  test_support::TemporaryFolder temporary;
  std::string path_before_;
};

TEST_F(SleepInhibitorTest, HoldsAsLongAsItLives) {
  const fs::path held = temporary.path() / "held";
  install("trap 'rm " + held.string() + "' EXIT\ntouch " + held.string() +
          "\nfor last; do :; done\n$last\n");
  {
    const SleepInhibitor inhibitor;
    EXPECT_TRUE(inhibitor.is_held());
    EXPECT_TRUE(fs::exists(held));
  }
  EXPECT_FALSE(fs::exists(held));
}

TEST_F(SleepInhibitorTest, ARefusalIsToldAndHurtsNobody) {
  install("exit 1\n");
  const SleepInhibitor inhibitor;
  EXPECT_FALSE(inhibitor.is_held());
}

TEST_F(SleepInhibitorTest, WhereThereIsNoneNothingIsHeld) {
  ::setenv("PATH", temporary.path().c_str(), 1);
  const SleepInhibitor inhibitor;
  EXPECT_FALSE(inhibitor.is_held());
}

}  // namespace sleep_inhibitor_test
}  // namespace jnd::app
