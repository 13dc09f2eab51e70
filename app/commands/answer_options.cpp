#include "app/commands/answer_options.h"

#include <CLI/CLI.hpp>

namespace jnd::app {

void add_answer_columns(CLI::App& command, AnswerRequest& options) {
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

void add_answer_options(CLI::App& command, AnswerRequest& options) {
  add_answer_columns(command, options);
  command.add_option("--intensity", options.intensity, "column of the intensities")
      ->option_text("COLUMN [intensity]");
  command
      .add_option("--group-by", options.group_by, "columns; one fit for each of their values")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->option_text("COLUMN[,COLUMN,..]");
}

}  // namespace jnd::app
