#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

namespace jnd::analysis {

/// The first of these programs that the PATH leads to; an empty path if none is installed.
[[nodiscard]] std::filesystem::path find_tool(const std::vector<std::string>& names);

/// What became of another program that was run to its end.
struct ToolOutcome {
  bool ok = false;      ///< It ended by itself, with exit code 0.
  std::string problem;  ///< What is to be said otherwise: its words, or "ended by signal 9".
};

/// Runs it in `folder` without a shell, input or terminal, its output taken, times in UTC. It
/// and what it started are ended when the time is over. Not real time.
[[nodiscard]] ToolOutcome run_tool(const std::filesystem::path& program,
                                   const std::vector<std::string>& arguments,
                                   const std::filesystem::path& folder,
                                   std::chrono::seconds time_limit = std::chrono::seconds(60));

}  // namespace jnd::analysis
