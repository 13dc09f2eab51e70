#include "analysis/export/table_rows.h"

#include <algorithm>
#include <set>

#include "experiments/study/question_answer.h"

namespace jnd::analysis {
std::vector<ExportedTrial> exported_trials(const core::StudyStore& store,
                                           std::int64_t session) {
  std::vector<std::int64_t> standing;
  for (const core::TrialRow& row : store.trials(session)) standing.push_back(row.sequence);
  std::sort(standing.begin(), standing.end());
  const std::string hash = store.session(session).protocol_sha256;
  StoredStudies studies(store);
  std::vector<ExportedTrial> trials;
  for (core::TrialRow& row : store.trials(session, true)) {
    const bool stands = std::binary_search(standing.begin(), standing.end(), row.sequence);
    const experiments::Block& block = studies.block(hash, row.block);
    trials.push_back({.row = std::move(row),
                      .excluded = !stands,
                      .is_practice = block.practice.has_value(),
                      .standard_medium = block.standard_medium});
  }
  return trials;
}

std::vector<ExportedPresentation> exported_presentations(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials) {
  std::set<std::int64_t> excluded;
  for (const ExportedTrial& trial : trials) {
    if (trial.excluded) excluded.insert(trial.row.trial);
  }
  std::vector<ExportedPresentation> presentations;
  for (core::PresentationRow& row : store.presentations(session, true)) {
    const bool is_excluded = excluded.contains(row.trial);
    presentations.push_back({.row = std::move(row), .excluded = is_excluded});
  }
  return presentations;
}

std::vector<ExportedAnswer> exported_question_answers(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials) {
  std::set<std::int64_t> excluded;
  for (const ExportedTrial& trial : trials) {
    if (trial.excluded) excluded.insert(trial.row.trial);
  }
  const std::string hash = store.session(session).protocol_sha256;
  StoredStudies studies(store);
  std::vector<ExportedAnswer> answers;
  for (core::QuestionAnswerRow& row : store.question_answers(session, true)) {
    const experiments::Block& block = studies.block(hash, row.block);
    const auto asked =
        std::ranges::find(block.questions, row.question, &experiments::QuestionnaireItem::name);
    ExportedAnswer answer{.row = std::move(row)};
    answer.excluded = excluded.contains(answer.row.trial);
    if (asked != block.questions.end()) {
      answer.kind = asked->kind;
      answer.unit = asked->unit;
      answer.asked = in_english(asked->question);
      if (asked->kind == "scale") {
        answer.asked += " From 1, " + in_english(asked->low_label) + ", to " +
                        std::to_string(asked->num_steps) + ", " + in_english(asked->high_label);
      }
      if (asked->kind == "scale" || asked->kind == "number") {
        answer.value = experiments::number_in(answer.row.answer);
      }
    }
    answers.push_back(std::move(answer));
  }
  return answers;
}

const std::vector<QuestionnaireItem>& StudyQuestions::of(const core::SessionRow& session) {
  const auto [found, is_new] = by_hash_.try_emplace(session.protocol_sha256);
  if (is_new) {
    found->second = questionnaire_items(studies_.study(session.protocol_sha256));
  }
  return found->second;
}

std::string field_column(const std::string& field, const std::vector<std::string>& taken) {
  return std::ranges::find(taken, field) == taken.end() ? field : "field_" + field;
}

}  // namespace jnd::analysis
