#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "experiments/study/study_problem.h"

namespace jnd::experiments {

// What reading a file of people's has in common, whatever is in it.

/// The whole file, or a problem in words. `kind`: what it should be, "study file". Not real
/// time.
[[nodiscard]] std::optional<std::string> text_of_file(const std::filesystem::path& file,
                                                      const std::string& kind,
                                                      std::vector<StudyProblem>& problems);

/// Whether the text is not far more than anybody writes; else that is a problem.
[[nodiscard]] bool is_of_a_size(const std::string& text, const std::string& file_name,
                                const std::string& kind, std::vector<StudyProblem>& problems);

/// In the order in which they stand in the file, and not too many.
void arrange(std::vector<StudyProblem>& problems, const std::string& file_name);

}  // namespace jnd::experiments
