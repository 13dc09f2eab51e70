#pragma once

#include <string>
#include <utility>
#include <vector>

#include "analysis/data/answer_cells.h"
#include "analysis/data/answer_file.h"
#include "analysis/fits/curve_fit.h"

namespace jnd::app {

/// The file, and the roles of its columns; all fits of anybody's tables share it.
struct AnswerRequest {
  std::string csv, intensity = "intensity", yes, yes_value, trials;
  std::vector<std::string> group_by, where;
  bool json = false;

  friend bool operator==(const AnswerRequest&, const AnswerRequest&) = default;
};

/// Which columns are the answers: num_yes and num_trials if none is named.
[[nodiscard]] analysis::AnswerWords answer_words(const AnswerRequest& request);

/// The column and the cell of each --where. Throws `UsageError` for anything but COLUMN=VALUE.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> where_of(
    const AnswerRequest& request);

/// Reads the groups of the file. If no column of answers is named, the columns are num_yes and
/// num_trials. Throws `UsageError` for a --where that is not COLUMN=VALUE, and `core::Error` as
/// `read_answer_file` does.
[[nodiscard]] analysis::AnswerFile read_answers(const AnswerRequest& request,
                                                bool signed_intensities);

[[nodiscard]] std::vector<analysis::AnswerCount> rows_of(const analysis::AnswerGroup& group);

/// A group in words, such as "condition A, block 2"; "" for a group of all rows.
[[nodiscard]] std::string words_of(const analysis::AnswerGroup& group);

/// What was left out and what was added up, one sentence each.
[[nodiscard]] std::vector<std::string> notes_of(const analysis::AnswerFile& file,
                                                const AnswerRequest& request);

}  // namespace jnd::app
