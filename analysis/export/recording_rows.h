#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "analysis/export/exported_recording.h"
#include "analysis/export/recording_columns.h"

namespace jnd::analysis {

/// The part of a recording that a data set contains: the chosen channels of the chosen blocks,
/// at the chosen rate. Not real time.
class RecordingRows {
 public:
  /// Throws `core::Error` for a channel that no recording can have, and for a rate that is not
  /// a whole fraction of the session's. `blocks` holds the ticks of the chosen blocks,
  /// ascending. If it is empty, the whole recording is used.
  RecordingRows(const ExportedRecording& recording, const core::SessionRow& session,
                const ExportSelection& selection, std::vector<core::TickRange> blocks = {});

  /// The first column is the tick.
  [[nodiscard]] const std::vector<RecordingColumn>& columns() const noexcept {
    return columns_;
  }
  /// The number of ticks of the loop in one row.
  [[nodiscard]] std::int64_t ticks_per_row() const noexcept { return ticks_per_row_; }
  [[nodiscard]] double rate_hz() const noexcept { return rate_hz_; }

  /// Calls `visit` for each row of the recorded ticks from `first_tick` to `last_tick`, with a
  /// value for each column. If a row stands for several ticks, its tick is the first of them,
  /// whether or not that one is recorded. Its flags are those of any of them. All other values
  /// are the mean over the recorded ticks, rounded to the stored step.
  using Visit = std::function<void(const std::vector<double>& values)>;
  void read(std::int64_t first_tick, std::int64_t last_tick, const Visit& visit) const;
  /// Reads all of the chosen blocks.
  void read(const Visit& visit) const;

 private:
  const ExportedRecording& recording_;
  std::vector<RecordingColumn> columns_;
  std::vector<core::TickRange> blocks_;
  std::int64_t ticks_per_row_ = 1;
  double rate_hz_ = 0.0;
};

}  // namespace jnd::analysis
