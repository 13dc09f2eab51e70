#pragma once

#include <filesystem>
#include <vector>

#include "core/sample.h"

namespace jnd::core {

/// The last second before a fault, as CSV beside the session's recording. For example,
/// recordings/0001.fault-000012345.csv is for the fault in tick 12345 of session 1. It is
/// written even if nothing else is recorded, and any program can read it. Not real time.

/// Writes the record, with the columns of `sample_column_names`, and returns its file. A file
/// that exists stays as it is. There must be at least one sample; the last one is that of the
/// fault. Throws `Error` naming the file; nothing of the file remains then.
std::filesystem::path write_flight_record(const std::filesystem::path& recording_file,
                                          const std::vector<Sample>& samples);

/// Returns all flight records of a session, in the order of their ticks.
[[nodiscard]] std::vector<std::filesystem::path> flight_records(
    const std::filesystem::path& recording_file);

}  // namespace jnd::core
