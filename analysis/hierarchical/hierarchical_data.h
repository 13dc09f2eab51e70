#pragma once

#include <optional>

#include "analysis/data/csv_table.h"
#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// Reads the columns participant, intensity, num_yes, num_trials and, where there are,
/// condition and reference, which goes before `reference`. Participants and conditions are
/// words, the reference is a number however it is written: an entry has the rows that agree in
/// all three. Throws `core::Error` with every problem, each "FILE:LINE: column: expected this,
/// found that", or where a row has no reference from either.
[[nodiscard]] std::vector<ParticipantAnswers> read_participant_answers(
    const CsvTable& table, std::optional<double> reference);

}  // namespace jnd::analysis
