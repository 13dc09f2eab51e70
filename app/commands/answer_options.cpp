#include "app/commands/answer_options.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>

#include "app/command_line/command.h"
#include "app/commands/fit_words.h"

namespace jnd::app {

void add_answer_columns(CLI::App& command, AnswerOptions& options) {
  command
      .add_option("--csv", options.csv,
                  "table of trials or counts: commas, semicolons or tabs between the cells, or "
                  "jsPsych's JSON")
      ->required();
  command
      .add_option("--yes", options.yes,
                  "column of the answers: 0 or 1, true or false, -1 or 1; with --trials how "
                  "many were yes")
      ->option_text("COLUMN [num_yes]");
  command
      .add_option("--yes-value", options.yes_value,
                  "the cell that is a yes; every other one is a no")
      ->option_text("CELL");
  command
      .add_option("--trials", options.trials,
                  "column of how many trials a row is; where --yes is given, 1 without it")
      ->option_text("COLUMN [num_trials]");
  command
      .add_option("--where", options.where,
                  "take the rows alone that have this cell; may be given several times")
      ->allow_extra_args(false)
      ->option_text("COLUMN=CELL");
}

void add_answer_options(CLI::App& command, AnswerOptions& options) {
  add_answer_columns(command, options);
  command.add_option("--intensity", options.intensity, "column of the intensities")
      ->option_text("COLUMN [intensity]");
  command
      .add_option("--group-by", options.group_by, "columns; one fit for each of their values")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("COLUMN[,COLUMN,..]");
}

analysis::AnswerWords answer_words(const AnswerOptions& options) {
  analysis::AnswerWords words{
      .yes = options.yes.empty() ? "num_yes" : options.yes, .yes_value = {}, .trials = {}};
  if (!options.yes_value.empty()) words.yes_value = options.yes_value;
  if (!options.trials.empty()) {
    words.trials = options.trials;
  } else if (options.yes.empty()) {
    words.trials = "num_trials";
  }
  return words;
}

std::vector<std::pair<std::string, std::string>> where_of(const AnswerOptions& options) {
  std::vector<std::pair<std::string, std::string>> where;
  for (const std::string& one : options.where) {
    const std::size_t sign = one.find('=');
    if (sign == 0 || sign == std::string::npos) {
      throw UsageError(fmt::format("--where: expected COLUMN=CELL, found {}", one));
    }
    where.emplace_back(one.substr(0, sign), one.substr(sign + 1));
  }
  return where;
}

analysis::AnswerFile read_answers(const AnswerOptions& options, bool signed_intensities) {
  const analysis::AnswerWords words = answer_words(options);
  return analysis::read_answer_file(options.csv, {.intensity = options.intensity,
                                                  .yes = words.yes,
                                                  .yes_value = words.yes_value,
                                                  .trials = words.trials,
                                                  .group_by = options.group_by,
                                                  .where = where_of(options),
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
                                  const AnswerOptions& options) {
  std::vector<std::string> notes;
  if (file.num_elsewhere > 0) {
    notes.push_back(
        fmt::format("left out {} of {} rows by --where", file.num_elsewhere, file.num_rows));
  }
  for (const auto& [column, number] : file.num_missing) {
    notes.push_back(fmt::format("left out {} of {} rows, which have nothing in the column {}",
                                number, file.num_rows, column));
  }
  for (const auto& [column, number] : file.num_pooled) {
    notes.push_back(fmt::format(
        "answers of {} values of the column {} are added up into one curve, which is flatter "
        "than theirs where they differ: --group-by {}{}{} fits each of them",
        number, column, fmt::join(options.group_by, ","), options.group_by.empty() ? "" : ",",
        column));
  }
  return notes;
}

}  // namespace jnd::app
