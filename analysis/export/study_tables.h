#pragma once

#include <string>
#include <vector>

#include "analysis/export/csv_table_writer.h"
#include "core/storage/study_store.h"

namespace jnd::analysis {

// The columns of every table, as codebook and sidecars tell them: one spelling for all data
// sets.

[[nodiscard]] const std::vector<CsvColumn>& session_columns();
[[nodiscard]] const std::vector<CsvColumn>& participant_columns();
[[nodiscard]] const std::vector<CsvColumn>& trial_columns();
[[nodiscard]] const std::vector<CsvColumn>& presentation_columns();
[[nodiscard]] const std::vector<CsvColumn>& event_columns();
[[nodiscard]] const std::vector<CsvColumn>& answer_columns();
[[nodiscard]] const std::vector<CsvColumn>& questionnaire_columns();
[[nodiscard]] const std::vector<CsvColumn>& gap_columns();

/// How many of the columns of trials and presentations say whose they are, not what was done:
/// BIDS says that by the name of the file.
inline constexpr std::size_t kNumTrialOwners = 3;
inline constexpr std::size_t kNumPresentationOwners = 2;

/// A trial whose answer stands.
struct ExportedTrial {
  core::TrialRow row;
  bool excluded = false;  ///< Set aside with a reason.
};
/// In the order of the answers.
[[nodiscard]] std::vector<ExportedTrial> exported_trials(const core::StudyStore& store,
                                                         std::int64_t session);

/// The cells after the owner's; the row is not ended.
void write_trial(CsvTableWriter& table, const ExportedTrial& trial);
void write_presentation(CsvTableWriter& table, const core::PresentationRow& row);

/// A column of a recording.
struct RecordingColumn {
  std::string name;  ///< As `core::sample_column_names`.
  std::string unit;
  std::string meaning;
  int decimals = 0;  ///< It was stored in steps of 10^-decimals.
};
[[nodiscard]] std::vector<RecordingColumn> recording_columns(bool with_joints);

/// Ticks that a recording lacks between two that it has.
struct RecordingGap {
  std::int64_t first_tick = 0, last_tick = 0;
};

/// Finds the gaps between ticks told in their order.
class GapFinder {
 public:
  /// The gap that lies before this tick, if there is one; a tick told twice is none.
  std::optional<RecordingGap> tell(std::int64_t tick);

 private:
  std::optional<std::int64_t> previous_;
};

}  // namespace jnd::analysis
