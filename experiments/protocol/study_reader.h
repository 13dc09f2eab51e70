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

/// Reads a study from its text. `file_name` is for messages.
[[nodiscard]] Study read_study_text(const std::string& text, const std::string& file_name);

/// The same for the text in a study folder, which sessions were begun with: that a block cannot
/// come to what it is for (`Procedure::check`) is no problem any more, for its answers are
/// there, to be gone on with and told of.
[[nodiscard]] Study read_stored_study(const std::string& text, const std::string& file_name);

/// What that text says, without a question whether this version of the program would run it: of
/// answers that are there, everything has to be told. What is missing has its default or is
/// empty. Throws `Error` where the text is no JSON object, or holds something that a study has
/// not.
[[nodiscard]] Study study_as_written(const std::string& text, const std::string& file_name);

/// Every problem, without throwing; empty for a sound study.
[[nodiscard]] std::vector<StudyProblem> study_problems(const std::filesystem::path& file);
[[nodiscard]] std::vector<StudyProblem> study_text_problems(const std::string& text,
                                                            const std::string& file_name);

/// What a sound study may not mean, each to be looked at: see `level_doubts`. It can be run all
/// the same. Empty where there are problems.
[[nodiscard]] std::vector<StudyProblem> study_doubts(const std::filesystem::path& file);
[[nodiscard]] std::vector<StudyProblem> study_text_doubts(const std::string& text,
                                                          const std::string& file_name);

}  // namespace jnd::experiments
