#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/study/study.h"
#include "experiments/study/study_problem.h"

namespace jnd::experiments {

/// Reads a study file. Throws `ProtocolError` with every problem of the file, in the order in
/// which they stand in it. A file that cannot be read is one problem. Not real time.
[[nodiscard]] Study read_study(const std::filesystem::path& file);

/// Reads a study from its text. `file_name` is for messages.
[[nodiscard]] Study read_study_text(const std::string& text, const std::string& file_name);

/// Does the same for the text in a study folder, with which sessions have begun. That a block
/// cannot reach its goal (`Procedure::check`) is then no problem, because its answers exist, to
/// be continued and reported.
[[nodiscard]] Study read_stored_study(const std::string& text, const std::string& file_name);

/// Returns what that text says, without checking whether this version of the program would run
/// it, so that all existing answers can be reported. Missing keys have their default or are
/// empty. Throws `Error` if the text is no JSON object, or holds something that no study has.
[[nodiscard]] Study study_as_written(const std::string& text, const std::string& file_name);

/// Return every problem without throwing; none for a valid study.
[[nodiscard]] std::vector<StudyProblem> study_problems(const std::filesystem::path& file);
[[nodiscard]] std::vector<StudyProblem> study_text_problems(const std::string& text,
                                                            const std::string& file_name);

/// Return what a valid study may not mean, for the author to check: see `level_doubts`. The
/// study can be run all the same. Empty if there are problems.
[[nodiscard]] std::vector<StudyProblem> study_doubts(const std::filesystem::path& file);
[[nodiscard]] std::vector<StudyProblem> study_text_doubts(const std::string& text,
                                                          const std::string& file_name);

}  // namespace jnd::experiments
