#include "analysis/hierarchical/hierarchical_data.h"

#include <map>
#include <utility>

#include "analysis/fits/fit_data.h"
#include "core/error.h"

namespace jnd::analysis {

std::vector<ParticipantAnswers> read_participant_answers(const CsvTable& table,
                                                         std::optional<double> reference) {
  const bool has_condition = table.find("condition").has_value();
  const bool has_reference = table.find("reference").has_value();
  if (!has_reference && !reference) {
    throw core::Error(table.name() +
                      ": expected a column reference or --reference, found neither");
  }
  std::vector<double> references(table.num_rows(), reference.value_or(0.0));
  if (has_reference) {
    CsvReader reader(table);
    references = reader.numbers("reference");
    for (std::size_t row = 0; row < references.size(); ++row) {
      // Cells that are not numbers have been reported before.
      if (references[row] <= 0.0) reader.report(row, "reference", "a number > 0");
    }
    reader.throw_problems();
  }
  std::map<int, double> reference_of_line;
  for (std::size_t row = 0; row < references.size(); ++row) {
    reference_of_line[table.line(row)] = references[row];
  }
  std::vector<std::string> columns = {"participant"};
  if (has_condition) columns.emplace_back("condition");
  std::vector<ParticipantAnswers> all;
  for (const DataGroup<AnswerCount>& group : read_answer_counts(table, columns)) {
    // Rows are grouped by the number, because 1 and 1.0 are the same reference. The fit rejects
    // several references.
    std::map<double, std::vector<AnswerCount>> by_reference;
    for (std::size_t row = 0; row < group.rows.size(); ++row) {
      by_reference[reference_of_line.at(group.lines[row])].push_back(group.rows[row]);
    }
    for (auto& [its_reference, rows] : by_reference) {
      all.push_back({.participant = group.key[0].second,
                     .condition = has_condition ? group.key[1].second : "",
                     .reference = its_reference,
                     .rows = std::move(rows)});
    }
  }
  return all;
}

}  // namespace jnd::analysis
