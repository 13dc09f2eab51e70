#pragma once

#include <string>

namespace jnd::experiments {

/// JSON Schema (draft 7) of the study format, made from the parameter tables: the meaning,
/// unit, range, default and allowed words of every key, and an example of every stage kind. It
/// is for editors and for reading; the reader checks more, for example that names differ.
/// Indented, with a line end. Not real time.
[[nodiscard]] std::string study_schema();

}  // namespace jnd::experiments
