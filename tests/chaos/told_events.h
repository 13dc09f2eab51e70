#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "support/program.h"

namespace jnd::chaos {

/// Collects the events of a session of which the program said that they are on the disk, and
/// judges whether they are.
class ToldEvents {
 public:
  explicit ToldEvents(std::filesystem::path study) : study_(std::move(study)) {}

  [[nodiscard]] bool empty() const noexcept { return lines_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return lines_.size(); }
  void add(const std::string& line) { lines_.push_back(line); }
  /// Takes the whole lines of the output: the last line of a killed program may have been cut
  /// off.
  void take(const test_support::ProgramOutcome& outcome);

  /// What is missing in the study, or what `jnd verify` finds wrong about it; "" if nothing.
  [[nodiscard]] std::string problem(const test_support::ProgramOptions& options) const;
  /// Whether there is a session to resume, although the program may not yet have told anything
  /// of it.
  [[nodiscard]] bool has_session() const;
  [[nodiscard]] bool session_is_complete() const;

 private:
  std::filesystem::path study_;
  std::vector<std::string> lines_;
};

}  // namespace jnd::chaos
