#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "support/program.h"

namespace jnd::chaos {

/// The events of a session of which the program said that they are on the disk. The judge of
/// whether they are.
class ToldEvents {
 public:
  explicit ToldEvents(std::filesystem::path study) : study_(std::move(study)) {}

  [[nodiscard]] bool empty() const noexcept { return lines_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return lines_.size(); }
  void add(const std::string& line) { lines_.push_back(line); }
  /// Whole lines count: the last one of a killed program may have been cut off.
  void take(const test_support::ProgramOutcome& outcome);

  /// What is missing in the study, or wrong about it by the word of `jnd verify`; "": nothing.
  [[nodiscard]] std::string problem(const test_support::ProgramOptions& options) const;
  /// Whether there is a session to resume, although nothing may have been told of it yet.
  [[nodiscard]] bool has_session() const;
  [[nodiscard]] bool session_is_complete() const;

 private:
  std::filesystem::path study_;
  std::vector<std::string> lines_;
};

}  // namespace jnd::chaos
