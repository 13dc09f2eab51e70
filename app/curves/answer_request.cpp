#include "app/curves/answer_request.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/command_line/command.h"
#include "app/curves/fit_words.h"

namespace jnd::app {

analysis::AnswerWords answer_words(const AnswerRequest& request) {
  analysis::AnswerWords words{
      .yes = request.yes.empty() ? "num_yes" : request.yes, .yes_value = {}, .trials = {}};
  if (!request.yes_value.empty()) words.yes_value = request.yes_value;
  if (!request.trials.empty()) {
    words.trials = request.trials;
  } else if (request.yes.empty()) {
    words.trials = "num_trials";
  }
  return words;
}

std::vector<std::pair<std::string, std::string>> where_of(const AnswerRequest& request) {
  std::vector<std::pair<std::string, std::string>> where;
  for (const std::string& one : request.where) {
    const std::size_t sign = one.find('=');
    if (sign == 0 || sign == std::string::npos) {
      throw UsageError(fmt::format("--where: expected COLUMN=CELL, found {}", one));
    }
    where.emplace_back(one.substr(0, sign), one.substr(sign + 1));
  }
  return where;
}

analysis::AnswerFile read_answers(const AnswerRequest& request, bool signed_intensities) {
  const analysis::AnswerWords words = answer_words(request);
  return analysis::read_answer_file(request.csv, {.intensity = request.intensity,
                                                  .yes = words.yes,
                                                  .yes_value = words.yes_value,
                                                  .trials = words.trials,
                                                  .group_by = request.group_by,
                                                  .where = where_of(request),
                                                  .signed_intensities = signed_intensities});
}

std::vector<analysis::AnswerCount> rows_of(const analysis::AnswerGroup& group) {
  std::vector<analysis::AnswerCount> rows;
  rows.reserve(group.tallies.size());
  for (const analysis::AnswerTally& one : group.tallies) {
    rows.push_back({one.intensity, one.num_yes, one.num_trials});
  }
  return rows;
}

std::string words_of(const analysis::AnswerGroup& group) {
  std::string words;
  for (const auto& [column, value] : group.key) {
    words += (words.empty() ? "" : ", ") + column + " " + group_words(value);
  }
  return words;
}

std::vector<std::string> notes_of(const analysis::AnswerFile& file,
                                  const AnswerRequest& request) {
  std::vector<std::string> notes;
  if (file.num_elsewhere > 0) {
    notes.push_back(
        fmt::format("left out {} of {} rows by --where", file.num_elsewhere, file.num_rows));
  }
  for (const auto& [column, number] : file.num_missing) {
    notes.push_back(fmt::format("left out {} of {} rows, which have nothing in the column {}",
                                number, file.num_rows, column));
  }
  if (file.num_no.size() > 1) {
    std::string words;
    for (const auto& [cell, number] : file.num_no) {
      words += fmt::format("{}{} of {}", words.empty() ? "" : ", ", number,
                           cell.empty() ? "nothing" : analysis::shown_cell(cell));
    }
    notes.push_back(fmt::format(
        "--yes-value {}: every other cell counts as a no, and there are several: {}; --where "
        "leaves out rows that are no answers",
        request.yes_value, words));
  }
  for (const auto& [column, number] : file.num_pooled) {
    notes.push_back(fmt::format(
        "answers of {} values of the column {} are added up into one curve, which is flatter "
        "than theirs where they differ: --group-by {}{}{} fits each of them",
        number, column, fmt::join(request.group_by, ","), request.group_by.empty() ? "" : ",",
        column));
  }
  return notes;
}

}  // namespace jnd::app
