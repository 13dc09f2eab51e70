#pragma once

#include <string>
#include <vector>

#include "experiments/study/parameter_table.h"

namespace jnd::experiments {

/// The keys of a device profile. Reader, messages, schema and reference are made from it.
[[nodiscard]] const ParameterTable& device_profile_table();

/// It and every table in it.
[[nodiscard]] std::vector<const ParameterTable*> device_profile_tables();

/// What a profile calls the schema that lies beside the studies'.
inline constexpr const char* kDeviceProfileSchemaFileName = "device_profile.schema.json";

/// JSON Schema (draft 7) of profiles; see `file_schema`. Not real time.
[[nodiscard]] std::string device_profile_schema();

/// Every key as a reference to read, in Markdown. Not real time.
[[nodiscard]] std::string device_profile_reference();

}  // namespace jnd::experiments
