#pragma once

#include <string>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// Returns the JSON Schema (draft 7) of the study format, made from the parameter tables:
/// meaning, unit, range, default and allowed words of every key, and an example of every stage
/// kind and procedure. It is for editors and for human readers. The study reader checks more,
/// for example that names differ. `markdownDescription`, `defaultSnippets` and the like belong
/// to VS Code, and other validators skip them. The schema is indented and ends in a line end.
/// Not real time.
[[nodiscard]] std::string study_schema();

/// Returns the same for another kind of file, which has neither texts by language nor stages.
/// The first of `tables` is that of the whole file.
[[nodiscard]] std::string file_schema(const std::vector<const ParameterTable*>& tables,
                                      const std::string& title);

/// The name by which a study file refers to its schema, which lies beside it. So the schema is
/// found offline, and moves with the study.
inline constexpr const char* kSchemaFileName = "study.schema.json";

}  // namespace jnd::experiments
