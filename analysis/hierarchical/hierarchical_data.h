#pragma once

#include <optional>

#include "analysis/data/csv_table.h"
#include "analysis/hierarchical/hierarchical_fit.h"

namespace jnd::analysis {

/// Reads the columns participant, intensity, num_yes and num_trials and, if they exist,
/// condition and reference. The column reference takes precedence over the argument
/// `reference`. Participants and conditions are compared as words, and references as numbers.
/// An entry holds the rows that agree in all three. Throws `core::Error` with every problem in
/// the form "FILE:LINE: column: expected this, found that", and if a row has no reference from
/// either source.
[[nodiscard]] std::vector<ParticipantAnswers> read_participant_answers(
    const CsvTable& table, std::optional<double> reference);

}  // namespace jnd::analysis
