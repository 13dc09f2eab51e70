#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "analysis/planning/power_summary.h"
#include "app/planning/power_study.h"

namespace jnd::app {

/// "shard-2-of-8.json"
[[nodiscard]] std::string shard_file_name(const PowerShard& shard);

/// Writes a shard's runs into the folder, which is made if absent: the whole file or none; one
/// of this name is replaced. Returns its path. Throws `core::Error` for what cannot be written.
std::filesystem::path write_power_shard(const std::filesystem::path& folder,
                                        const PowerDesign& design, const PowerShard& shard,
                                        const std::vector<analysis::PlannedRun>& runs);

/// The runs of all shards, in the order of their numbers: the same as of one process.
struct MergedPower {
  PowerDesign design;
  std::vector<analysis::PlannedRun> runs;
};
/// Throws `core::Error`, one sentence: a file that is no shard, one of another study, request
/// or program version, a shard given twice, one that is missing.
[[nodiscard]] MergedPower merge_power_shards(const std::vector<std::filesystem::path>& files);

/// What is told once all runs are there.
struct PowerOutput {
  std::filesystem::path out;  ///< New or empty folder for power.json and the figure; or none.
  bool json = false;          ///< One JSON document on stdout instead of the table.
};
/// Prints, and writes the folder as a whole or not at all. Without gnuplot the figure's script
/// and table remain, and stderr says so.
void tell_power(const PowerDesign& design, const std::vector<analysis::PlannedRun>& runs,
                const PowerOutput& output);

/// The table that is printed.
[[nodiscard]] std::string power_table(
    const PowerDesign& design, const std::vector<analysis::PlannedSummary>& summaries,
    const std::optional<analysis::SequentialPower>& sequential);

}  // namespace jnd::app
