#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "analysis/export/export_options.h"
#include "core/storage/recording.h"

namespace jnd::analysis {

/// The recording of a session, compared with what the session's events speak of. Throws `Error`
/// if the file is foreign; `read` also if a chunk is damaged. Not real time.
class ExportedRecording {
 public:
  ExportedRecording(const core::StudyStore& store, const core::SessionRow& session,
                    const ExportOptions& options);

  /// Whether there is any sample.
  [[nodiscard]] bool any() const noexcept { return !ticks_.empty(); }
  [[nodiscard]] bool has_joints() const { return any() && reader_->has_joints(); }
  /// The ticks of its samples, ascending and merged.
  [[nodiscard]] const std::vector<core::TickRange>& ticks() const noexcept { return ticks_; }
  /// Ticks that it lacks: between its samples, and what an event speaks of before the first and
  /// after the last.
  [[nodiscard]] const std::vector<core::TickRange>& gaps() const noexcept { return gaps_; }
  /// A sentence if it lacks ticks of which an event speaks; "" otherwise, and for a session of
  /// which only summaries were kept.
  [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
  void read(std::int64_t first_tick, std::int64_t last_tick,
            const std::function<void(const core::Sample&)>& visit) const;

 private:
  std::function<void()> keep_going_;
  std::optional<core::RecordingReader> reader_;
  std::vector<core::TickRange> ticks_, gaps_;
  std::string problem_;
};

}  // namespace jnd::analysis
