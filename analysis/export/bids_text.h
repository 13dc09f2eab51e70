#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "analysis/export/table_writer.h"

namespace jnd::analysis {

/// The version that the data sets keep to.
inline constexpr char kBidsVersion[] = "1.9.0";

/// A label for each name, as BIDS allows it in a file name: its letters and digits alone, "x"
/// where it has none. Those that would be one, also where file names do not tell upper from
/// lower case, get "x2", "x3" at their end. Depends on the names alone, not on their order.
[[nodiscard]] std::map<std::string, std::string> bids_labels(std::vector<std::string> names);

/// "2026-11-20T19:05:00.250000Z".
[[nodiscard]] std::string iso_time(std::int64_t time_ns);
/// "2026-11-20".
[[nodiscard]] std::string iso_date(std::int64_t time_ns);

/// Columns as a sidecar describes them: {"intensity": {"Description": ..., "Units": ...}}.
[[nodiscard]] nlohmann::ordered_json described(const std::vector<CsvColumn>& columns,
                                               std::size_t num_left_out = 0);

/// Throw `Error` naming the file if it cannot be written.
void write_text(const std::filesystem::path& file, const std::string& text);
void write_json(const std::filesystem::path& file, const nlohmann::ordered_json& json);

}  // namespace jnd::analysis
