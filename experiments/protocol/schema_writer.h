#pragma once

#include <string>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// JSON Schema (draft 7) of the study format, made from the parameter tables: the meaning,
/// unit, range, default and allowed words of every key, and an example of every stage kind and
/// procedure. It is for editors and for reading; the reader checks more, for example that names
/// differ. `markdownDescription`, `defaultSnippets` and the like are words of VS Code, which
/// other validators skip. Indented, with a line end. Not real time.
[[nodiscard]] std::string study_schema();

/// The same of another kind of file that has neither texts by language nor stages. `tables`:
/// that of the whole file first.
[[nodiscard]] std::string file_schema(const std::vector<const ParameterTable*>& tables,
                                      const std::string& title);

/// What a study file calls the schema that lies beside it: offline, and wherever both go.
inline constexpr const char* kSchemaFileName = "study.schema.json";

}  // namespace jnd::experiments
