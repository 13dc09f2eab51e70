#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/data/answer_cells.h"
#include "analysis/data/answer_file.h"
#include "analysis/fits/curve_fit.h"

namespace jnd::app {

/// Which file, and which of its columns are what: shared by the fits of anybody's tables.
struct AnswerRequest {
  std::string csv, intensity = "intensity", yes, yes_value, trials;
  std::vector<std::string> group_by, where;
  bool json = false;

  friend bool operator==(const AnswerRequest&, const AnswerRequest&) = default;
};

/// Which columns are the answers: num_yes and num_trials where none is named.
[[nodiscard]] analysis::AnswerWords answer_words(const AnswerRequest& request);

/// Column and cell of each --where. Throws `UsageError` for what is no COLUMN=VALUE.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> where_of(
    const AnswerRequest& request);

/// The groups of the file. Where no column of answers is named they are num_yes and num_trials.
/// Throws `UsageError` for a --where that is no COLUMN=VALUE, `core::Error` as
/// `read_answer_file`.
[[nodiscard]] analysis::AnswerFile read_answers(const AnswerRequest& request,
                                                bool signed_intensities);

[[nodiscard]] std::vector<analysis::AnswerCount> rows_of(const analysis::AnswerGroup& group);

/// "condition A, block 2"; "" for a group of all rows.
[[nodiscard]] std::string words_of(const analysis::AnswerGroup& group);

/// What was left out and what was added up, a sentence each.
[[nodiscard]] std::vector<std::string> notes_of(const analysis::AnswerFile& file,
                                                const AnswerRequest& request);

}  // namespace jnd::app
