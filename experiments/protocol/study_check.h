#pragma once

#include <string>
#include <utility>
#include <vector>

#include "experiments/protocol/located_json.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// The base of all checks of a study file: the file, and the list to which they report
/// problems.
class StudyCheck {
 public:
  StudyCheck(const LocatedJson& file, std::vector<StudyProblem>& problems)
      : file_(file), problems_(problems) {}

 protected:
  /// Reports a problem of the value at this JSON pointer.
  void report(const std::string& pointer, std::string message) {
    const TextPosition position = file_.value_position(pointer);
    add_problem(problems_,
                {file_.file(), position.line, position.column, pointer, std::move(message)});
  }

  const LocatedJson& file_;
  std::vector<StudyProblem>& problems_;
};

}  // namespace jnd::experiments
