#include "analysis/report/answer_words.h"
#include "analysis/report/report_results.h"
#include "analysis/results/number_words.h"
#include "analysis/words/said.h"

namespace jnd::analysis {
namespace {

const Estimate* find(const ResultsSection& section, const std::string& name) {
  for (const Estimate& estimate : section.estimates) {
    if (estimate.name == name) return &estimate;
  }
  return nullptr;
}

std::string value_of(const ResultsSection& section, const std::string& name) {
  const Estimate* const estimate = find(section, name);
  return estimate == nullptr ? "–" : number_words(estimate->value, 2);
}

/// Adds a row with item, question, count, mean and spread, and one column for each further
/// statistic.
void add_row(HtmlTable& table, const ResultsSection& section, const QuestionnaireItem& item,
             const std::vector<const char*>& statistics) {
  const std::string name = "questionnaire." + item.name;
  const Estimate* const mean = find(section, name);
  if (mean == nullptr) return;
  std::string interval = number_words(mean->value, 2);
  if (mean->ci95.low && mean->ci95.high) {
    interval += said(" ({}\u00a0to\u00a0{})", number_words(mean->ci95.low, 2),
                     number_words(mean->ci95.high, 2));
  }
  std::vector<std::string> row = {item.name, item.question, std::to_string(mean->n), interval};
  for (const char* const statistic : statistics) {
    row.push_back(value_of(section, name + statistic));
  }
  table.rows.push_back(std::move(row));
}

std::vector<HtmlTable::Column> columns_with(const std::vector<const char*>& titles) {
  std::vector<HtmlTable::Column> columns = {{said("Item"), false, true},
                                            {said("Question")},
                                            {"n", true},
                                            {said("Mean (95 % interval)"), true}};
  for (const char* const title : titles) columns.push_back({title, true});
  return columns;
}

/// The labels of the ends of a scale, such as "1: fluid, 10: solid".
std::string ends_words(const QuestionnaireItem& item) {
  std::string words = item.low_label.empty() ? "" : "1: " + item.low_label;
  if (item.high_label.empty()) return words;
  return words + (words.empty() ? "" : ", ") + std::to_string(item.num_steps) + ": " +
         item.high_label;
}

void write_counts(HtmlText& html, const StudyData& data, const ResultsSection& section) {
  HtmlTable table{
      .caption = said("Choices: how many gave each answer"),
      .columns = {
          {said("Item"), false, true}, {said("Question")}, {"n", true}, {said("Answers")}}};
  for (const QuestionnaireItem& item : data.items) {
    if (item.kind == "scale" || item.kind == "number") continue;
    const std::string start = "questionnaire." + item.name + ".";
    std::string answers;
    int num_answered = 0;
    for (const Estimate& estimate : section.estimates) {
      if (!estimate.name.starts_with(start)) continue;
      answers += (answers.empty() ? "" : ", ") +
                 answer_words(estimate.name.substr(start.size()), item) + " " +
                 number_words(estimate.value);
      num_answered = estimate.n;
    }
    if (!answers.empty()) {
      table.rows.push_back({item.name, item.question, std::to_string(num_answered), answers});
    }
  }
  html.table(table);
}

}  // namespace

void write_questionnaires(HtmlText& html, const StudyData& data,
                          const ResultsSection& section) {
  HtmlTable ratings{.caption = said("Ratings from 1, the worst, to the last step, the best; "
                                    "scales asked the other way are turned round"),
                    .columns = columns_with({"sd", said("Median")})};
  HtmlTable steps{
      .caption = said("Steps of scales without a better end, as they were asked, from 1"),
      .columns = columns_with({"sd", said("Median"), said("Ends")})};
  HtmlTable numbers{.caption = said("Numbers"),
                    .columns = columns_with({"sd", said("Smallest"), said("Largest")})};
  for (const QuestionnaireItem& item : data.items) {
    if (item.kind == "scale") {
      HtmlTable& table = item.high_is_good ? ratings : steps;
      const std::size_t num_rows = table.rows.size();
      add_row(table, section, item, {".sd", ".median"});
      const bool is_neutral = !item.high_is_good && table.rows.size() > num_rows;
      if (is_neutral) table.rows.back().push_back(ends_words(item));
    }
    if (item.kind == "number") {
      add_row(numbers, section, item, {".sd", ".minimum", ".maximum"});
    }
  }
  html.table(ratings);
  html.table(steps);
  html.table(numbers);
  write_counts(html, data, section);
}

}  // namespace jnd::analysis
