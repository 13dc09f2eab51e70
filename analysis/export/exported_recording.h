#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/export/export_options.h"
#include "core/sample_table.h"
#include "core/storage/recording.h"

namespace jnd::analysis {

/// The recording of a session, compared with the ticks that the session's events mention.
/// Throws `Error` if the file does not belong to the session. `read` also throws if a chunk is
/// damaged. Not real time.
class ExportedRecording {
 public:
  ExportedRecording(const core::StudyStore& store, const core::SessionRow& session,
                    const ExportOptions& options);

  /// Whether there are samples.
  [[nodiscard]] bool any() const noexcept { return !ticks_.empty(); }
  /// The columns that it has in addition to the usual ones.
  [[nodiscard]] core::SampleColumns columns() const {
    return any() ? core::SampleColumns{.times = reader_->has_times(),
                                       .joints = reader_->has_joints(),
                                       .channels = reader_->channels()}
                 : core::SampleColumns{};
  }
  /// The ticks of its samples, ascending and merged.
  [[nodiscard]] const std::vector<core::TickRange>& ticks() const noexcept { return ticks_; }
  /// The ticks that it lacks: between its samples, and those that an event mentions before the
  /// first and after the last. Ticks that never ran are gaps too.
  [[nodiscard]] const std::vector<core::TickRange>& gaps() const noexcept { return gaps_; }
  /// The number of a gap's ticks that never ran. The others are lost.
  [[nodiscard]] std::int64_t num_missed(const core::TickRange& gap) const {
    return core::num_ticks({gap}) - core::num_ticks(core::missing_in(missed_, gap));
  }
  /// A sentence if it has lost ticks that an event mentions. It is "" otherwise, and for a
  /// session of which only summaries were kept.
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
  void read(std::int64_t first_tick, std::int64_t last_tick,
            const std::function<void(const core::Sample&)>& visit) const;

 private:
  std::function<void()> keep_going_;
  std::optional<core::RecordingReader> reader_;
  std::vector<core::TickRange> ticks_, gaps_, missed_;
  std::string problem_;
};

}  // namespace jnd::analysis
