#pragma once

#include <string>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// The keys of a device profile. Reader, messages, schema and reference are made from this
/// table.
[[nodiscard]] const ParameterTable& device_profile_table();

/// Returns this table and every table in it.
[[nodiscard]] std::vector<const ParameterTable*> device_profile_tables();

/// The name by which a profile refers to its schema, which lies in the same folder.
inline constexpr const char* kDeviceProfileSchemaFileName = "device_profile.schema.json";

/// Returns the JSON Schema (draft 7) of profiles; see `file_schema`. Not real time.
[[nodiscard]] std::string device_profile_schema();

/// Returns a reference of every key, in Markdown. Not real time.
[[nodiscard]] std::string device_profile_reference();

}  // namespace jnd::experiments
