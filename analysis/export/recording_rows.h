#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "analysis/export/exported_recording.h"
#include "analysis/export/recording_columns.h"

namespace jnd::analysis {

/// What of a recording goes into a data set: the chosen channels of the chosen blocks, at the
/// chosen rate. Not real time.
class RecordingRows {
 public:
  /// Throws `core::Error` for a channel that no recording can have, and for a rate that is not
  /// a whole fraction of the session's. `blocks`: ticks of the chosen ones, ascending; empty:
  /// all of the recording.
  RecordingRows(const ExportedRecording& recording, const core::SessionRow& session,
                const ExportSelection& selection, std::vector<core::TickRange> blocks = {});

  /// The first is the tick.
  [[nodiscard]] const std::vector<RecordingColumn>& columns() const noexcept {
    return columns_;
  }
  /// How many ticks of the loop a row stands for.
  [[nodiscard]] std::int64_t ticks_per_row() const noexcept { return ticks_per_row_; }
  [[nodiscard]] double rate_hz() const noexcept { return rate_hz_; }

  /// A row with a value for each column, of the ticks from `first_tick` to `last_tick` that are
  /// recorded. Where a row stands for several ticks its tick is the first of them, whether that
  /// one is recorded or not, its flags are those of any of them, and all else is the mean of
  /// those that are recorded, rounded to the step that was stored.
  using Visit = std::function<void(const std::vector<double>& values)>;
  void read(std::int64_t first_tick, std::int64_t last_tick, const Visit& visit) const;
  /// All of the chosen blocks.
  void read(const Visit& visit) const;

 private:
  const ExportedRecording& recording_;
  std::vector<RecordingColumn> columns_;
  std::vector<core::TickRange> blocks_;
  std::int64_t ticks_per_row_ = 1;
  double rate_hz_ = 0.0;
};

}  // namespace jnd::analysis
