#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/study.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Reads a study file. Throws `ProtocolError` with every problem of the file, in the order in
/// which they stand in it; a file that cannot be read is one problem. Not real time.
[[nodiscard]] Study read_study(const std::filesystem::path& file);

/// The same for a text, for example one out of a study folder. `file_name` is for messages.
[[nodiscard]] Study read_study_text(const std::string& text, const std::string& file_name);

/// Every problem, without throwing; empty for a sound study.
[[nodiscard]] std::vector<StudyProblem> study_problems(const std::filesystem::path& file);
[[nodiscard]] std::vector<StudyProblem> study_text_problems(const std::string& text,
                                                            const std::string& file_name);

}  // namespace jnd::experiments
