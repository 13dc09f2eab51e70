#include "app/planning/power_files.h"

#include <unistd.h>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <optional>

#include "analysis/export/unfinished_folder.h"
#include "analysis/report/figure_files.h"
#include "analysis/report/run_tool.h"
#include "analysis/report/study_power_figure.h"
#include "app/command_line/json_text.h"
#include "app/planning/power_json.h"
#include "core/error.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr char kKind[] = "jnd power shard";

/// A shard that was read.
struct ReadShard {
  fs::path file;
  PowerShard shard;
  ordered_json design;
  ordered_json runs;
};

[[noreturn]] void refuse(const fs::path& file, const std::string& expected,
                         const std::string& found) {
  throw core::Error(file.string() + ": expected " + expected + ", found " + found);
}

ReadShard read_shard(const fs::path& file) {
  std::error_code error;
  std::ifstream stream;
  if (!fs::is_directory(file, error)) stream.open(file, std::ios::binary);
  if (!stream.is_open()) {
    refuse(file, "a file of `jnd power --shard`", "none that can be read");
  }
  const std::string text{std::istreambuf_iterator<char>(stream), {}};
  const ordered_json json = ordered_json::parse(text, nullptr, false);
  if (!json.is_object() || json.value("kind", ordered_json()) != kKind ||
      json.value("format", ordered_json()) != 1) {
    refuse(file, "a whole file of `jnd power --shard` of format 1", "something else");
  }
  try {
    ReadShard read{.file = file,
                   .shard = {.index = json.at("shard").at(0).get<int>() - 1,
                             .count = json.at("shard").at(1)},
                   .design = json.at("design"),
                   .runs = json.at("runs")};
    constexpr int kMostShards = 100'000;
    if (read.shard.count > kMostShards || read.shard.index < 0 ||
        read.shard.index >= read.shard.count || !read.runs.is_array()) {
      refuse(file, "a shard I of N with its runs", "others");
    }
    return read;
  } catch (const ordered_json::exception&) {
    refuse(file, "a whole file of `jnd power --shard`", "parts missing");
  }
}

/// Throws for the first difference between the requests of two shards.
void require_same_design(const ReadShard& first, const ReadShard& other) {
  if (other.shard.count != first.shard.count) {
    refuse(
        other.file,
        "one of " + std::to_string(first.shard.count) + " shards as in " + first.file.string(),
        "one of " + std::to_string(other.shard.count));
  }
  if (other.design == first.design) return;
  for (const auto& [key, value] : first.design.items()) {
    if (other.design.contains(key) && other.design.at(key) == value) continue;
    refuse(other.file, "the same " + key + " as in " + first.file.string(),
           "another; shards of different requests cannot be merged");
  }
  refuse(other.file, "the same request as in " + first.file.string(), "another");
}

std::vector<analysis::PlannedRun> runs_of(const ReadShard& shard, const PowerDesign& design) {
  try {
    std::vector<analysis::PlannedRun> runs;
    for (const ordered_json& run : shard.runs) {
      runs.push_back(planned_run_of(run, design.analysis));
    }
    if (runs.size() == shard.shard.runs_of(design.request.num_runs).size()) return runs;
  } catch (const ordered_json::exception&) {
  } catch (const core::Error&) {
  }
  refuse(shard.file, "all runs of its shard", "some that are missing or damaged");
}

}  // namespace

std::string shard_file_name(const PowerShard& shard) {
  return "shard-" + std::to_string(shard.index + 1) + "-of-" + std::to_string(shard.count) +
         ".json";
}

fs::path write_power_shard(const fs::path& folder, const PowerDesign& design,
                           const PowerShard& shard,
                           const std::vector<analysis::PlannedRun>& runs) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    throw core::Error(folder.string() +
                      ": expected to make this folder, found: " + error.message());
  }
  auto all = ordered_json::array();
  for (const analysis::PlannedRun& run : runs) all.push_back(to_json(run));
  const ordered_json document = {{"kind", kKind},
                                 {"format", 1},
                                 {"shard", {shard.index + 1, shard.count}},
                                 {"design", to_json(design)},
                                 {"runs", std::move(all)}};
  fs::path file = folder / shard_file_name(shard);
  // The process's id is part of the name, because another process may write the same shard.
  const fs::path unfinished = file.string() + ".unfinished-" + std::to_string(::getpid());
  try {
    analysis::write_text_file(unfinished, document.dump() + "\n");
    fs::rename(unfinished, file);
  } catch (...) {
    fs::remove(unfinished, error);
    throw;
  }
  return file;
}

MergedPower merge_power_shards(const std::vector<fs::path>& files) {
  std::vector<std::optional<ReadShard>> shards;
  std::optional<fs::path> first;
  for (const fs::path& file : files) {
    ReadShard read = read_shard(file);
    if (shards.empty()) shards.resize(static_cast<std::size_t>(read.shard.count));
    if (!first) {
      first = file;
    } else {
      for (const auto& known : shards) {
        if (known) {
          require_same_design(*known, read);
          break;
        }
      }
    }
    std::optional<ReadShard>& place = shards[static_cast<std::size_t>(read.shard.index)];
    if (place) {
      refuse(file, "every shard once",
             "shard " + std::to_string(read.shard.index + 1) + " that " + place->file.string() +
                 " is already");
    }
    place = std::move(read);
  }
  for (std::size_t i = 0; i < shards.size(); ++i) {
    if (shards[i]) continue;
    refuse(*first, "all " + std::to_string(shards.size()) + " shards with it",
           "that shard " + std::to_string(i + 1) + " is missing");
  }
  MergedPower merged;
  try {
    merged.design = power_design_of(shards.front()->design);
  } catch (const ordered_json::exception&) {
    refuse(*first, "a whole file of `jnd power --shard`", "parts of its design missing");
  }
  merged.runs.resize(static_cast<std::size_t>(merged.design.request.num_runs));
  for (const auto& shard : shards) {
    std::vector<analysis::PlannedRun> runs = runs_of(*shard, merged.design);
    const auto numbers = shard->shard.runs_of(merged.design.request.num_runs);
    for (std::size_t i = 0; i < runs.size(); ++i) {
      merged.runs[static_cast<std::size_t>(numbers[i])] = std::move(runs[i]);
    }
  }
  return merged;
}

void tell_power(const PowerDesign& design, const std::vector<analysis::PlannedRun>& runs,
                const PowerOutput& output) {
  const auto summaries = analysis::summary_of_runs(design.analysis, runs);
  std::vector<analysis::SequentialRun> by_looks;
  for (const analysis::PlannedRun& run : runs) {
    if (run.sequential) by_looks.push_back(*run.sequential);
  }
  const auto sequential = analysis::sequential_power(design.analysis.sequential, by_looks);
  const std::string document = json_text(power_result(design, summaries, sequential)) + "\n";
  if (!output.out.empty()) {
    analysis::UnfinishedFolder folder(output.out);
    analysis::write_text_file(folder.path() / "power.json", document);
    const auto drawn = analysis::write_figures(
        analysis::power_figures(
            design.analysis, summaries,
            {.study = design.study,
             .laboratory = design.laboratory,
             .num_runs = design.request.num_runs,
             .null_hypothesis =
                 design.request.null_hypothesis || analysis::nothing_differs(design.analysis)}),
        folder.path(), {.simulated = true, .gnuplot = analysis::find_tool({"gnuplot"})});
    folder.publish();
    for (const analysis::DrawnFigure& figure : drawn) {
      if (!figure.problem.empty()) std::fprintf(stderr, "jnd: %s\n", figure.problem.c_str());
    }
  }
  std::fputs(
      output.json ? document.c_str() : power_table(design, summaries, sequential).c_str(),
      stdout);
}

}  // namespace jnd::app
