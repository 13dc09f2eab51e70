#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/planning/power_summary.h"
#include "app/planning/power_study.h"

namespace jnd::app {

/// Such as "shard-2-of-8.json".
[[nodiscard]] std::string shard_file_name(const PowerShard& shard);

/// Writes a shard's runs into the folder, and makes the folder if necessary. The file is
/// written as a whole or not at all, and replaces one of the same name. Returns its path.
/// Throws `core::Error` if it cannot be written.
std::filesystem::path write_power_shard(const std::filesystem::path& folder,
                                        const PowerDesign& design, const PowerShard& shard,
                                        const std::vector<analysis::PlannedRun>& runs);

/// The runs of all shards in the order of their numbers, as one process would have computed
/// them.
struct MergedPower {
  PowerDesign design;
  std::vector<analysis::PlannedRun> runs;
};
/// Throws `core::Error` in one sentence for a file that is no shard, for one of another study,
/// request or program version, and for a shard that is given twice or missing.
[[nodiscard]] MergedPower merge_power_shards(const std::vector<std::filesystem::path>& files);

/// What is printed and written once all runs are there.
struct PowerOutput {
  /// A new or empty folder for power.json and the figure; empty for none.
  std::filesystem::path out;
  bool json = false;  ///< Prints one JSON document on stdout instead of the table.
};
/// Prints the result, and writes the folder as a whole or not at all. Without gnuplot, the
/// figure's script and table remain, and stderr says so.
void tell_power(const PowerDesign& design, const std::vector<analysis::PlannedRun>& runs,
                const PowerOutput& output);

/// The table that is printed.
[[nodiscard]] std::string power_table(
    const PowerDesign& design, const std::vector<analysis::PlannedSummary>& summaries,
    const std::optional<analysis::SequentialPower>& sequential);

}  // namespace jnd::app
