#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "app/tiny_study.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace power_slurm_test {

namespace fs = std::filesystem;

/// Does what `data/cluster/README.md` shows in a Slurm of this machine alone: an array of four
/// shards, and the merge that waits for it.
TEST(PowerSlurm, AJobArrayAndItsMergeGiveTheBytesOfOneProcess) {
  if (::geteuid() != 0) GTEST_SKIP() << "slurmd runs jobs only as root";
  for (const char* program : {"slurmctld", "slurmd", "munged", "sbatch"}) {
    if (!fs::exists(fs::path("/usr/bin") / program) &&
        !fs::exists(fs::path("/usr/sbin") / program)) {
      GTEST_SKIP() << program << " is not installed: apt-get install slurm-wlm munge";
    }
  }
  // Jobs see this folder under the same name, which is short enough for a socket.
  const test_support::TemporaryFolder temporary;
  const fs::path source = test_support::source_folder();
  const std::string words =
      "viscosity_discrimination --participants 6,8..10 --runs 30 --seed 9";
  const std::string command =
      "bash '" + (source / "tests/app/commands/power_slurm.sh").string() + "' '" +
      temporary.path().string() + "' '" + test_support::program_file().string() + "' '" +
      (source / "data/cluster/power.slurm").string() + "' '" +
      (temporary.path() / "result").string() + "' " + words + " >'" +
      (temporary.path() / "said").string() + "' 2>&1";
  const int code = std::system(command.c_str());
  ASSERT_EQ(code, 0) << read_file(temporary.path() / "said");
  const auto whole =
      test_support::run_program({"power", "viscosity_discrimination", "--participants",
                                 "6,8..10", "--runs", "30", "--seed", "9", "--out", "whole"},
                                {.folder = temporary.path(), .environment = {}});
  ASSERT_EQ(whole.exit_code, 0) << whole.err;
  int num_shards = 0;
  for (const auto& entry : fs::directory_iterator(temporary.path() / "result/shards")) {
    EXPECT_TRUE(entry.path().filename().string().ends_with("-of-4.json")) << entry.path();
    ++num_shards;
  }
  EXPECT_EQ(num_shards, 4);
  for (const auto& entry : fs::directory_iterator(temporary.path() / "whole")) {
    const fs::path merged = temporary.path() / "result/power" / entry.path().filename();
    ASSERT_TRUE(fs::exists(merged)) << merged;
    EXPECT_EQ(read_file(merged), read_file(entry.path())) << merged;
  }
}

}  // namespace power_slurm_test
}  // namespace jnd::app
