#include "app/commands/script_parts.h"

#include <nlohmann/json.hpp>

namespace jnd::app {

std::string quoted(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string yes_column(const AnswerRequest& options) {
  return options.yes.empty() ? "num_yes" : options.yes;
}
std::string trials_column(const AnswerRequest& options) {
  if (!options.trials.empty()) return options.trials;
  return options.yes.empty() ? "num_trials" : "";
}

std::string r_table_text(const AnswerRequest& options) {
  std::string text;
  text += "file <- " + quoted(options.csv) + "\n";
  text +=
      "missing <- c(\"NA\", \"na\", \"NaN\", \"\")\n"
      "if (grepl(\"^\\\\s*[\\\\[{]\", readLines(file, 1, warn = FALSE))) {\n"
      "  data <- jsonlite::flatten(jsonlite::fromJSON(file))\n"
      "} else {\n"
      "  header <- readLines(file, 1, warn = FALSE)\n"
      "  count <- function(s) lengths(regmatches(header, gregexpr(s, header, fixed = TRUE)))\n"
      "  separator <- c(\"\\t\", \";\", \",\")[which.max(c(count(\"\\t\"), count(\";\"), "
      "count(\",\")))]\n"
      "  data <- read.table(file, header = TRUE, sep = separator, quote = \"\\\"\", fill = "
      "TRUE,\n"
      "                     check.names = FALSE, colClasses = \"character\", na.strings = "
      "missing,\n"
      "                     strip.white = TRUE, comment.char = \"\", fileEncoding = "
      "\"UTF-8-BOM\")\n"
      "}\n"
      "number <- function(cells) as.numeric(sub(\",\", \".\", cells, fixed = TRUE))\n";
  for (const std::string& one : options.where) {
    const std::size_t sign = one.find('=');
    text += "data <- data[which(as.character(data[[" + quoted(one.substr(0, sign)) +
            "]]) == " + quoted(one.substr(sign + 1)) + "), ]\n";
  }
  return text;
}

std::string r_answers_text(const AnswerRequest& options) {
  std::string text;
  const std::string trials = trials_column(options);
  text += trials.empty() ? "n <- rep(1, nrow(data))\n"
                         : "n <- number(data[[" + quoted(trials) + "]])\n";
  text += "answer <- data[[" + quoted(yes_column(options)) +
          "]]\n"
          "# Of JSON, cells without an answer and answers in parts are lists.\n"
          "if (is.list(answer)) {\n"
          "  answer <- sapply(answer, function(cell) if (length(cell) == 1) "
          "as.character(cell) else NA)\n"
          "}\n"
          "answer <- as.character(answer)\n";
  if (!options.yes_value.empty()) {
    text += "yes <- n * (answer == " + quoted(options.yes_value) + ")\n";
  } else {
    text +=
        "words <- c(true = 1, yes = 1, false = 0, no = 0, \"-1\" = 0)\n"
        "yes <- ifelse(tolower(answer) %in% names(words), words[tolower(answer)], "
        "suppressWarnings(number(answer)))\n";
    if (!trials.empty()) text += "yes <- ifelse(n == 1 & yes < 0, 0, yes)\n";
  }
  return text;
}

}  // namespace jnd::app
