#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/study_problem.h"

namespace jnd::experiments {

// Functions for reading any file that people write.

/// Returns the whole file, or adds a problem. `kind` is what it should be, such as "study
/// file". Not real time.
[[nodiscard]] std::optional<std::string> text_of_file(const std::filesystem::path& file,
                                                      const std::string& kind,
                                                      std::vector<StudyProblem>& problems);

/// Whether the text is of a reasonable size; if not, adds a problem.
[[nodiscard]] bool is_of_a_size(const std::string& text, const std::string& file_name,
                                const std::string& kind, std::vector<StudyProblem>& problems);

/// Sorts the problems by their place in the file and limits their number.
void arrange(std::vector<StudyProblem>& problems, const std::string& file_name);

}  // namespace jnd::experiments
