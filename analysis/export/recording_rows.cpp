#include "analysis/export/recording_rows.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

#include "core/error.h"
#include "core/sample_table.h"

namespace jnd::analysis {
namespace {

/// The channels that a recording of any device may have.
std::vector<std::string> known_channels() {
  core::SampleColumns every{.times = true, .joints = true};
  every.channels = static_cast<core::ChannelBits>(~core::ChannelBits{0});
  std::vector<std::string> arrays;
  for (const RecordingColumn& column : recording_columns(every)) {
    const std::string& array = column.column.array;
    if (column.is_flags || column.name() == "tick") continue;
    if (std::ranges::find(arrays, array) == arrays.end()) arrays.push_back(array);
  }
  return arrays;
}

void check_channels(const std::vector<std::string>& chosen) {
  const std::vector<std::string> known = known_channels();
  for (const std::string& channel : chosen) {
    if (std::ranges::find(known, channel) != known.end()) continue;
    std::string all;
    for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;
    throw core::Error("--channel: expected one of " + all + ", found `" + channel + "`");
  }
}

std::int64_t ticks_per_row_of(double chosen_hz, const core::SessionRow& session) {
  if (chosen_hz == 0.0) return 1;
  const double ticks = session.rate_hz / chosen_hz;
  // The comparison also rejects NaN.
  if (!(ticks >= 1.0 && ticks < 1e9 && std::abs(ticks - std::round(ticks)) < 1e-9 * ticks)) {
    char text[160];
    std::snprintf(text, sizeof text,
                  "--rate-hz: expected the rate of session %lld, which is %g Hz, or a whole "
                  "fraction of it, as %g, found %g",
                  static_cast<long long>(session.session), session.rate_hz,
                  session.rate_hz / 10.0, chosen_hz);
    throw core::Error(text);
  }
  return std::llround(ticks);
}

/// The row that is made from several ticks.
class RowOfTicks {
 public:
  explicit RowOfTicks(const std::vector<RecordingColumn>& columns)
      : columns_(columns), sums_(columns.size()), counts_(columns.size()) {}

  [[nodiscard]] bool empty() const noexcept { return num_ticks_ == 0; }

  void add(const std::vector<double>& values) {
    ++num_ticks_;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const double value = values[columns_[i].index];
      if (std::isnan(value)) continue;
      sums_[i] = columns_[i].is_flags ? any_of(sums_[i], value, columns_[i]) : sums_[i] + value;
      ++counts_[i];
    }
  }

  /// Returns the row and begins the next one.
  std::vector<double> take(std::int64_t first_tick) {
    std::vector<double> row(columns_.size());
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const RecordingColumn& column = columns_[i];
      row[i] = counts_[i] == 0 ? std::numeric_limits<double>::quiet_NaN()
               : column.is_flags
                   ? sums_[i]
                   : std::round(sums_[i] / counts_[i] / column.step()) * column.step();
    }
    row.front() = static_cast<double>(first_tick);
    std::ranges::fill(sums_, 0.0);
    std::ranges::fill(counts_, 0);
    num_ticks_ = 0;
    return row;
  }

 private:
  /// A fault is a code, and the last one counts. All other flags are bits.
  static double any_of(double a, double b, const RecordingColumn& column) {
    if (column.name() == "fault") return b == 0.0 ? a : b;
    return static_cast<double>(static_cast<std::uint64_t>(a) | static_cast<std::uint64_t>(b));
  }

  const std::vector<RecordingColumn>& columns_;
  std::vector<double> sums_;
  std::vector<int> counts_;
  int num_ticks_ = 0;
};

}  // namespace

RecordingRows::RecordingRows(const ExportedRecording& recording,
                             const core::SessionRow& session, const ExportSelection& selection,
                             std::vector<core::TickRange> blocks)
    : recording_(recording),
      columns_(recording_columns(recording.columns())),
      blocks_(core::merged(std::move(blocks))),
      ticks_per_row_(ticks_per_row_of(selection.rate_hz, session)),
      rate_hz_(session.rate_hz / static_cast<double>(ticks_per_row_)) {
  check_channels(selection.channels);
  if (!selection.channels.empty()) {
    std::erase_if(columns_, [&](const RecordingColumn& column) {
      const bool is_always = column.name() == "tick" || column.is_flags;
      return !is_always && std::ranges::find(selection.channels, column.column.array) ==
                               selection.channels.end();
    });
  }
  if (!selection.blocks.empty() && blocks_.empty()) blocks_.push_back({0, -1});
}

void RecordingRows::read(std::int64_t first_tick, std::int64_t last_tick,
                         const Visit& visit) const {
  const core::SampleColumns which = recording_.columns();
  if (ticks_per_row_ == 1) {
    std::vector<double> values(columns_.size());
    return recording_.read(first_tick, last_tick, [&](const core::Sample& sample) {
      const std::vector<double> all = core::sample_values(sample, which);
      for (std::size_t i = 0; i < columns_.size(); ++i) values[i] = all[columns_[i].index];
      visit(values);
    });
  }
  RowOfTicks row(columns_);
  std::int64_t begun = 0;
  const auto finish = [&] {
    if (!row.empty()) visit(row.take(begun));
  };
  recording_.read(first_tick, last_tick, [&](const core::Sample& sample) {
    // Rows are counted from the session's first tick, so that the rows of all blocks have a
    // common grid.
    const std::int64_t its = sample.tick - sample.tick % ticks_per_row_;
    if (its != begun) finish();
    begun = its;
    row.add(core::sample_values(sample, which));
  });
  finish();
}

void RecordingRows::read(const Visit& visit) const {
  if (blocks_.empty()) return read(0, INT64_MAX, visit);
  for (const core::TickRange& block : blocks_) read(block.first_tick, block.last_tick, visit);
}

}  // namespace jnd::analysis
