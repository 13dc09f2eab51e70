#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace jnd::experiments {

/// One thing wrong with a study file, told the way its author sees it.
struct StudyProblem {
  std::string file;
  int line = 0;         ///< From 1; 0 where the file as a whole is meant.
  int column = 0;       ///< From 1, in characters.
  std::string pointer;  ///< JSON pointer: "/stages/2/viscosity_pa_s"; "" is the whole document.
  std::string message;  ///< "expected a number > 0 (Pa s), found -1.5"
};

/// More are not told: whoever has so many makes one mistake many times.
inline constexpr std::size_t kMostProblems = 1000;

/// Adds a problem, its pointer shortened; nothing once there is one more than `kMostProblems`.
void add_problem(std::vector<StudyProblem>& problems, StudyProblem problem);

/// `FILE:LINE:COLUMN: /json/pointer: message`, or `FILE: message` where there is no place. The
/// whole document is written `/`. One line, whatever keys the file has.
[[nodiscard]] std::string to_string(const StudyProblem& problem);

/// Thrown once the whole file has been read: it carries every problem found, not the first one.
class ProtocolError : public core::Error {
 public:
  explicit ProtocolError(std::vector<StudyProblem> problems);

  [[nodiscard]] const std::vector<StudyProblem>& problems() const noexcept { return problems_; }

 private:
  std::vector<StudyProblem> problems_;
};

/// The candidate that `word` most likely was meant to be, by edit distance (a swap of
/// neighbours counts as one edit), or the one whose unit was left out; "" if none is near.
[[nodiscard]] std::string nearest_word(std::string_view word,
                                       const std::vector<std::string>& candidates);

/// "; did you mean `x`?" or "".
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string>& candidates);

}  // namespace jnd::experiments
