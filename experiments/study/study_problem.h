#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

namespace jnd::experiments {

/// One problem of a study file, in words for its author.
struct StudyProblem {
  std::string file;
  int line = 0;    ///< From 1; 0 if the problem is the file as a whole.
  int column = 0;  ///< From 1, in characters.
  /// JSON pointer, such as "/stages/2/viscosity_pa_s"; "" is the whole document.
  std::string pointer;
  std::string message;  ///< "expected a number > 0 (Pa s), found -1.5"
};

/// No more problems are reported, because so many come from one repeated mistake.
inline constexpr std::size_t kMostProblems = 1000;

/// Adds a problem with a shortened pointer. Does nothing if there are more than `kMostProblems`
/// already.
void add_problem(std::vector<StudyProblem>& problems, StudyProblem problem);

/// Returns `FILE:LINE:COLUMN: /json/pointer: message`, or `FILE: message` for a problem without
/// a place. The whole document is written `/`. The result is one line, whatever keys the file
/// has.
[[nodiscard]] std::string to_string(const StudyProblem& problem);

/// Thrown after the whole file has been read, with every problem found.
class ProtocolError : public core::Error {
 public:
  explicit ProtocolError(std::vector<StudyProblem> problems);

  [[nodiscard]] const std::vector<StudyProblem>& problems() const noexcept { return problems_; }

 private:
  std::vector<StudyProblem> problems_;
};

/// Returns the candidate that `word` most likely was meant to be, by edit distance (a swap of
/// neighbours counts as one edit), or the one whose unit was left out. Returns "" if none is
/// close.
[[nodiscard]] std::string nearest_word(std::string_view word,
                                       const std::vector<std::string>& candidates);

/// Returns "; did you mean `x`?" or "".
[[nodiscard]] std::string did_you_mean(std::string_view word,
                                       const std::vector<std::string>& candidates);

}  // namespace jnd::experiments
