#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace jnd::analysis {

/// The first of these programs that is found on the PATH; an empty path if none is installed.
[[nodiscard]] std::filesystem::path find_tool(const std::vector<std::string>& names);

/// The outcome of running another program to its end.
struct ToolOutcome {
  bool ok = false;      ///< Whether it ended by itself with exit code 0.
  std::string problem;  ///< What to report otherwise: its own words, or "ended by signal 9".
};

/// Runs a program in `folder` without a shell, input or terminal, with times in UTC. Its output
/// is captured. After the time limit the program and everything that it started are ended.
/// Not real time.
[[nodiscard]] ToolOutcome run_tool(const std::filesystem::path& program,
                                   const std::vector<std::string>& arguments,
                                   const std::filesystem::path& folder,
                                   std::chrono::seconds time_limit = std::chrono::seconds(60));

}  // namespace jnd::analysis
