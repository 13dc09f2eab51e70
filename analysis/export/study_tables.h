#pragma once

#include <vector>

#include "analysis/export/table_writer.h"

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
[[nodiscard]] const std::vector<CsvColumn>& codebook_columns();

/// How many columns of trials say whose they are, not what was done: BIDS says that by the name
/// of the file.
inline constexpr std::size_t kNumTrialOwners = 2;

}  // namespace jnd::analysis
