#pragma once

#include <filesystem>
#include <vector>

#include "core/sample.h"

namespace jnd::core {

/// The last second before a fault, as CSV beside the session's recording:
/// recordings/0001.fault-000012345.csv for the fault in tick 12345 of session 1. It is there
/// also where nothing else is recorded, and can be read with any program. Not real time.

/// Writes it, with the columns of `sample_column_names`, and returns the file; one that is
/// there already stays as it is. The last sample is the fault's. Throws `Error` naming the
/// file; none of it remains then. At least one sample.
std::filesystem::path write_flight_record(const std::filesystem::path& recording_file,
                                          const std::vector<Sample>& samples);

/// All of a session, in the order of their ticks.
[[nodiscard]] std::vector<std::filesystem::path> flight_records(
    const std::filesystem::path& recording_file);

}  // namespace jnd::core
