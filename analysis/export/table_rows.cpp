#include "analysis/export/table_rows.h"

#include <algorithm>
#include <map>

#include "experiments/procedures/procedure_registry.h"
#include "experiments/study/question_answer.h"

namespace jnd::analysis {
namespace {

std::optional<experiments::Measure> measure_of(const experiments::Block& block) {
  if (block.procedure.empty()) return std::nullopt;
  return experiments::procedure_named(block.procedure).measures(block);
}

}  // namespace

std::vector<ExportedTrial> exported_trials(const core::StudyStore& store, std::int64_t session,
                                           const ExportSelection& selection) {
  std::vector<std::int64_t> standing;
  for (const core::TrialRow& row : store.trials(session)) standing.push_back(row.sequence);
  std::sort(standing.begin(), standing.end());
  const std::string hash = store.session(session).protocol_sha256;
  StoredStudies studies(store);
  std::vector<ExportedTrial> trials;
  for (core::TrialRow& row : store.trials(session, true)) {
    if (!is_exported(selection, row.block)) continue;
    const bool stands = std::binary_search(standing.begin(), standing.end(), row.sequence);
    const experiments::Block& block = studies.block(hash, row.block);
    trials.push_back({.row = std::move(row),
                      .excluded = !stands,
                      .is_practice = block.practice.has_value(),
                      .standard_medium = block.standard_medium,
                      .measure = measure_of(block)});
  }
  return trials;
}

std::vector<ExportedPresentation> exported_presentations(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials) {
  std::map<std::int64_t, const ExportedTrial*> by_number;
  for (const ExportedTrial& trial : trials) by_number[trial.row.trial] = &trial;
  std::vector<ExportedPresentation> presentations;
  for (core::PresentationRow& row : store.presentations(session, true)) {
    const auto its = by_number.find(row.trial);
    if (its == by_number.end()) continue;  // It belongs to a block that was not chosen.
    presentations.push_back({.row = std::move(row),
                             .block = its->second->row.block,
                             .excluded = its->second->excluded});
  }
  return presentations;
}

std::vector<ExportedAnswer> exported_question_answers(
    const core::StudyStore& store, std::int64_t session,
    const std::vector<ExportedTrial>& trials) {
  std::map<std::int64_t, bool> excluded;
  for (const ExportedTrial& trial : trials) excluded[trial.row.trial] = trial.excluded;
  const std::string hash = store.session(session).protocol_sha256;
  StoredStudies studies(store);
  std::vector<ExportedAnswer> answers;
  for (core::QuestionAnswerRow& row : store.question_answers(session, true)) {
    const auto trial = excluded.find(row.trial);
    if (trial == excluded.end()) continue;
    const experiments::Block& block = studies.block(hash, row.block);
    const auto asked =
        std::ranges::find(block.questions, row.question, &experiments::QuestionnaireItem::name);
    ExportedAnswer answer{.row = std::move(row)};
    answer.excluded = trial->second;
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

std::vector<core::TickRange> ticks_of_blocks(
    const std::vector<ExportedTrial>& trials,
    const std::vector<ExportedPresentation>& presentations, const ExportSelection& selection) {
  if (selection.blocks.empty()) return {};
  std::map<std::string, core::TickRange> blocks;
  const auto widen = [&](const std::string& block, std::int64_t first_tick,
                         std::int64_t last_tick) {
    core::TickRange& its =
        blocks.try_emplace(block, core::TickRange{first_tick, last_tick}).first->second;
    its.first_tick = std::min(its.first_tick, first_tick);
    its.last_tick = std::max(its.last_tick, last_tick);
  };
  for (const ExportedTrial& one : trials) {
    widen(one.row.block, one.row.first_tick, one.row.last_tick);
  }
  for (const ExportedPresentation& one : presentations) {
    widen(one.block, one.row.first_tick, one.row.last_tick);
  }
  std::vector<core::TickRange> ticks;
  for (const auto& [block, its] : blocks) ticks.push_back(its);
  return core::merged(std::move(ticks));
}

std::string field_column(const std::string& field, const std::vector<std::string>& taken) {
  return std::ranges::find(taken, field) == taken.end() ? field : "field_" + field;
}

}  // namespace jnd::analysis
