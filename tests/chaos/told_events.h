#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "support/program.h"

namespace jnd::chaos {

/// Collects the events that the program acknowledged as stored, and judges whether they are.
class ToldEvents {
 public:
  explicit ToldEvents(std::filesystem::path study) : study_(std::move(study)) {}

  [[nodiscard]] bool empty() const noexcept { return lines_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return lines_.size(); }
  void add(const std::string& line) { lines_.push_back(line); }
  /// Adds whole lines only, because a killed program may have left an incomplete last line.
  void take(const test_support::ProgramOutcome& outcome);

  /// Returns what is missing in the study, or what `jnd verify` finds wrong with it, or "" if
  /// all is right.
  [[nodiscard]] std::string problem(const test_support::ProgramOptions& options) const;
  /// Returns whether there is a session to resume, even if no event of it was acknowledged yet.
  [[nodiscard]] bool has_session() const;
  [[nodiscard]] bool session_is_complete() const;

 private:
  std::filesystem::path study_;
  std::vector<std::string> lines_;
};

}  // namespace jnd::chaos
