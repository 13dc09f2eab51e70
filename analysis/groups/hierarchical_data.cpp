#include "analysis/groups/hierarchical_data.h"

#include <cmath>

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
  std::vector<std::string> columns = {"participant"};
  if (has_condition) columns.emplace_back("condition");
  if (has_reference) {
    columns.emplace_back("reference");
    CsvReader reader(table);
    const std::vector<double> values = reader.numbers("reference");
    for (std::size_t row = 0; row < values.size(); ++row) {
      // A cell that is no number has been reported.
      if (values[row] <= 0.0) reader.report(row, "reference", "a number > 0");
    }
    reader.throw_problems();
  }
  std::vector<ParticipantAnswers> all;
  for (const DataGroup<AnswerCount>& group : read_answer_counts(table, columns)) {
    ParticipantAnswers one{.participant = group.key[0].second,
                           .reference = reference.value_or(0.0),
                           .rows = group.rows};
    if (has_condition) one.condition = group.key[1].second;
    if (has_reference) one.reference = std::stod(group.key.back().second);
    all.push_back(std::move(one));
  }
  return all;
}

}  // namespace jnd::analysis
