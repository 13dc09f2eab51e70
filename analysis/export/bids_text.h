#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/export/table_writer.h"

namespace jnd::analysis {

/// The BIDS version of the data sets.
inline constexpr char kBidsVersion[] = "1.9.0";

/// A label for each name that BIDS allows in a file name: only its letters and digits, or "x"
/// if it has none. Equal labels, even if they differ in case, get "x2", "x3" appended. The
/// result depends only on the names, not on their order.
[[nodiscard]] std::map<std::string, std::string> bids_labels(std::vector<std::string> names);

/// A time as "2026-11-20T19:05:00.250000Z".
[[nodiscard]] std::string iso_time(std::int64_t time_ns);
/// A date as "2026-11-20".
[[nodiscard]] std::string iso_date(std::int64_t time_ns);

/// The description of columns in a sidecar: {"intensity": {"Description": ..., "Units": ...}}.
[[nodiscard]] nlohmann::ordered_json described(const std::vector<CsvColumn>& columns,
                                               std::size_t num_left_out = 0);

/// Both throw `Error` that names the file if it cannot be written.
void write_text(const std::filesystem::path& file, const std::string& text);
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);

}  // namespace jnd::analysis
