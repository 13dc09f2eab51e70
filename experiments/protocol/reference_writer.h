#pragma once

#include <string>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// Returns the reference of the study format in Markdown, made from the parameter tables: an
/// introduction, every key with type, unit, range, default and meaning, an example of every
/// stage kind and procedure, and the data that each of them writes. It is for people who design
/// studies and do not program. It ends in a line end. Not real time.
[[nodiscard]] std::string study_reference();

/// Returns the same for another kind of file, with this introduction.
[[nodiscard]] std::string file_reference(const ParameterTable& root,
                                         const std::string& introduction);

}  // namespace jnd::experiments
