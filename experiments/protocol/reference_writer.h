#pragma once

#include <string>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// Reference of the study format in Markdown, made from the parameter tables: an introduction,
/// then every key with type, unit, range, default and meaning, an example of every stage kind
/// and procedure, and the data each of them writes. Written for somebody who designs studies
/// and does not program. With a line end. Not real time.
[[nodiscard]] std::string study_reference();

/// The same of another kind of file, the introduction given.
[[nodiscard]] std::string file_reference(const ParameterTable& root,
                                         const std::string& introduction);

}  // namespace jnd::experiments
