#include "analysis/report/run_tool.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <fstream>

#include "support/temporary_folder.h"

namespace jnd::analysis {
namespace run_tool_test {

namespace fs = std::filesystem;

fs::path script(const fs::path& folder, const std::string& name, const std::string& text) {
  const fs::path file = folder / name;
  std::ofstream(file) << "#!/bin/sh\n" << text;
  fs::permissions(file, fs::perms::owner_all);
  return file;
}

TEST(RunTool, TellsWhatTheProgramSaidWhenItFails) {
  const test_support::TemporaryFolder temporary;
  const ToolOutcome outcome =
      run_tool(script(temporary.path(), "fails", "echo line 3: no such  column >&2\nexit 2\n"),
               {}, temporary.path());
  EXPECT_FALSE(outcome.ok);
  EXPECT_EQ(outcome.problem, "line 3: no such column ");
}

TEST(RunTool, RunsInItsFolderWithoutAShellAndInUtc) {
  const test_support::TemporaryFolder temporary;
  const ToolOutcome outcome =
      run_tool(script(temporary.path(), "works", "printf '%s|%s' \"$1\" \"$TZ\" > out\n"),
               {"$(touch bad); 'x'"}, temporary.path());
  EXPECT_TRUE(outcome.ok) << outcome.problem;
  std::ifstream file(temporary.path() / "out");
  std::string line;
  std::getline(file, line);
  EXPECT_EQ(line, "$(touch bad); 'x'|UTC");
  EXPECT_FALSE(fs::exists(temporary.path() / "bad"));
}

TEST(RunTool, EndsAProgramAndWhatItStartedWhenItsTimeIsOver) {
  const test_support::TemporaryFolder temporary;
  const auto start = std::chrono::steady_clock::now();
  const ToolOutcome outcome = run_tool(script(temporary.path(), "hangs", "sleep 100 | cat\n"),
                                       {}, temporary.path(), std::chrono::seconds(1));
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
  EXPECT_FALSE(outcome.ok);
  EXPECT_EQ(outcome.problem, "did not end within 1 s and was stopped");
}

TEST(RunTool, SaysThatAProgramIsNotThere) {
  const test_support::TemporaryFolder temporary;
  EXPECT_NE(
      run_tool(temporary.path() / "none", {}, temporary.path()).problem.find("cannot start"),
      std::string::npos);
}

TEST(FindTool, TakesTheFirstOfTheNamesThatIsAProgram) {
  const test_support::TemporaryFolder temporary;
  (void)script(temporary.path(), "second", "exit 0\n");
  std::ofstream(temporary.path() / "first") << "not executable";
  const char* const before = std::getenv("PATH");
  const std::string kept = before == nullptr ? "" : before;
  ::setenv("PATH", (":relative:" + temporary.path().string()).c_str(), 1);
  const fs::path found = find_tool({"first", "second"});
  const fs::path none = find_tool({"third"});
  ::setenv("PATH", kept.c_str(), 1);
  EXPECT_EQ(found, temporary.path() / "second");
  EXPECT_TRUE(none.empty());
}

}  // namespace run_tool_test
}  // namespace jnd::analysis
