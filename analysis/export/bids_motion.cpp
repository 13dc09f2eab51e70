#include "analysis/export/bids_motion.h"

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "analysis/export/bids_text.h"
#include "analysis/export/csv_table_writer.h"
#include "analysis/export/recording_rows.h"

namespace jnd::analysis {
namespace {

namespace fs = std::filesystem;

struct BidsChannel {
  std::string name, component, type, tracked_point, units, description;
};

std::string component_of(const std::string& name) {
  for (const char* part : {"w", "x", "y", "z"}) {
    if (name.ends_with(std::string("_orientation_") + part)) {
      return std::string("quat_") + part;
    }
  }
  for (const char* axis : {"x", "y", "z"}) {
    for (const char* unit : {"_m_per_s", "_m", "_n", "_n_m"}) {
      if (name.ends_with(std::string("_") + axis + unit)) return axis;
    }
  }
  return "n/a";
}

/// BIDS has no type for force, so force is MISC.
std::string bids_type_of(const RecordingColumn& column) {
  if (column.name().ends_with("_position_rad")) return "JNTANG";
  if (column.name().find("_orientation_") != std::string::npos) return "ORNT";
  if (column.name().find("_position_") != std::string::npos) return "POS";
  return column.unit == "m/s" ? "VEL" : "MISC";
}

std::string tracked_point_of(const std::string& name) {
  for (const char* what : {"_position_", "_velocity_", "_measured_force_", "_force_",
                           "_orientation_", "_torque_"}) {
    const std::size_t at = name.find(what);
    if (at != std::string::npos) return name.substr(0, at);
  }
  return "hand";
}

std::vector<BidsChannel> channels_of(const std::vector<RecordingColumn>& columns) {
  std::vector<BidsChannel> channels = {
      {"latency", "n/a", "LATENCY", "n/a", "s", "Time since the first sample of the task"}};
  for (const RecordingColumn& column : columns) {
    if (column.name() == "tick") continue;
    channels.push_back({.name = column.name(),
                        .component = component_of(column.name()),
                        .type = bids_type_of(column),
                        .tracked_point = tracked_point_of(column.name()),
                        .units = column.unit,
                        .description = column.meaning});
  }
  return channels;
}

void write_channels(const fs::path& front, const std::vector<BidsChannel>& channels,
                    double rate_hz) {
  CsvTableWriter table(
      front.string() + "_channels.tsv",
      std::vector<std::string>{"name", "component", "type", "tracked_point", "units",
                               "sampling_frequency", "reference_frame", "description"},
      TableStyle::kBids);
  for (const BidsChannel& channel : channels) {
    const bool spatial = channel.component != "n/a";
    table.cell(channel.name).cell(channel.component).cell(channel.type);
    table.cell(channel.tracked_point).cell(channel.units).cell(rate_hz);
    table.cell(spatial ? "workspace" : "").cell(channel.description).end_row();
  }
  table.finish();
  write_json(front.string() + "_channels.json",
             {{"reference_frame",
               {{"Levels",
                 {{"workspace",
                   {{"SpatialAxes", "RAS"},
                    {"Description",
                     "x to the participant's right, y away, z up; forces are those on the "
                     "hand"}}}}}}}});
}

struct Written {
  std::int64_t num_rows = 0;
  std::vector<core::TickRange> gaps;
};

/// Writes one row for each tick, or for a few ticks, from the block's first to its last, even
/// where the recording has gaps.
Written write_samples(const fs::path& file, const BidsBlock& block, double rate_hz,
                      const RecordingRows& rows) {
  const std::vector<RecordingColumn>& columns = rows.columns();
  std::vector<std::string> names;
  for (const RecordingColumn& column : columns) names.push_back(column.name());
  CsvTableWriter table(file, names, TableStyle::kBidsWithoutNames);
  const std::int64_t step = rows.ticks_per_row();
  const std::int64_t first = block.first_tick - block.first_tick % step;
  Written written;
  std::int64_t next = first;
  const auto latency = [&](std::int64_t tick) {
    table.cell(static_cast<double>(tick - first) / rate_hz);
    ++written.num_rows;
  };
  const auto mark_missing = [&](std::int64_t end) {
    if (next < end) written.gaps.push_back({std::max(next, block.first_tick), end - 1});
    for (; next < end; next += step) {
      latency(next);
      for (std::size_t i = 1; i < columns.size(); ++i) table.nothing();
      table.end_row();
    }
  };
  rows.read(block.first_tick, block.last_tick, [&](const std::vector<double>& values) {
    const auto tick = static_cast<std::int64_t>(values.front());
    if (tick < next) return;  // An earlier segment has written this row.
    mark_missing(tick);
    latency(tick);
    for (std::size_t i = 1; i < values.size(); ++i) {
      table.fixed_cell(values[i], columns[i].decimals, columns[i].tolerance);
    }
    table.end_row();
    next = tick + step;
  });
  mark_missing(block.last_tick + 1);
  table.finish();
  return written;
}

void write_sidecar(const fs::path& front, const BidsTask& task, const core::SessionRow& session,
                   const std::vector<BidsChannel>& channels, double rate_hz,
                   std::int64_t num_rows) {
  std::map<std::string, int> num_of;
  std::vector<std::string> points;
  for (const BidsChannel& channel : channels) {
    ++num_of[channel.type];
    if (channel.type == "POS") points.push_back(channel.tracked_point);
  }
  points.erase(std::unique(points.begin(), points.end()), points.end());
  const nlohmann::ordered_json sidecar = {
      {"TaskName", task.task_name},
      {"TaskDescription", task.description},
      {"SamplingFrequency", rate_hz},
      {"SamplingFrequencyEffective", rate_hz},
      {"RecordingDuration", static_cast<double>(num_rows) / rate_hz},
      {"RecordingType", "continuous"},
      {"TrackingSystemName", "haptic"},
      {"ManufacturersModelName",
       session.device + (session.simulated ? " (SIMULATED participant and apparatus)" : "")},
      {"SoftwareVersions", "jnd " + session.program_version},
      {"MissingValues", "n/a"},
      {"MotionChannelCount", std::ssize(channels)},
      {"TrackedPointsCount", std::ssize(points)},
      {"POSChannelCount", num_of["POS"]},
      {"VELChannelCount", num_of["VEL"]},
      {"JNTANGChannelCount", num_of["JNTANG"]},
      {"LATENCYChannelCount", num_of["LATENCY"]},
      {"MISCChannelCount", num_of["MISC"]},
  };
  write_json(front.string() + "_motion.json", sidecar);
}

bool holds_any(const ExportedRecording& recording, const BidsBlock& block) {
  const core::TickRange ticks{block.first_tick, block.last_tick};
  return core::num_ticks(core::missing_in(recording.ticks(), ticks)) < core::num_ticks({ticks});
}

}  // namespace

std::string write_bids_motion(const fs::path& folder, const BidsTask& task,
                              const BidsBlock& block, const core::SessionRow& session,
                              const ExportedRecording& recording,
                              const ExportSelection& selection) {
  if (!holds_any(recording, block)) return "";
  const fs::path front = folder / (task.front + "_tracksys-haptic");
  const RecordingRows rows(recording, session, selection,
                           {{block.first_tick, block.last_tick}});
  const std::vector<BidsChannel> channels = channels_of(rows.columns());
  std::string name = front.filename().string() + "_motion.tsv";
  const Written written = write_samples(folder / name, block, session.rate_hz, rows);
  write_channels(front, channels, rows.rate_hz());
  write_sidecar(front, task, session, channels, rows.rate_hz(), written.num_rows);
  write_bids_events(front, block, session, written.gaps);
  return name;
}

}  // namespace jnd::analysis
