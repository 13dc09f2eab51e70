#include "analysis/data/questionnaire_items.h"

#include <algorithm>
#include <map>
#include <set>
#include <variant>

#include "analysis/data/stored_studies.h"
#include "experiments/study/stage_walk.h"

namespace jnd::analysis {
namespace {

void add_options(QuestionnaireItem& item, const std::vector<experiments::Option>& options) {
  for (const experiments::Option& option : options) {
    item.options.push_back(option.value);
    item.option_labels.push_back(in_spoken_language(option.label));
  }
}

QuestionnaireItem item_of(const std::string& stage,
                          const experiments::QuestionnaireItem& written) {
  QuestionnaireItem item{.stage = stage,
                         .name = written.name,
                         .kind = written.kind,
                         .question = in_spoken_language(written.question),
                         .unit = written.unit};
  add_options(item, written.options);
  if (item.kind != "scale") return item;
  item.low_label = in_spoken_language(written.low_label);
  item.high_label = in_spoken_language(written.high_label);
  item.num_steps = written.num_steps;
  item.high_is_good = written.high_is_good;
  return item;
}

}  // namespace

std::vector<QuestionnaireItem> questionnaire_items(const experiments::Study& study) {
  std::vector<QuestionnaireItem> items;
  for_each_stage(study.stages, [&](const experiments::Stage& stage) {
    if (const auto* form = std::get_if<experiments::Questionnaire>(&stage.content)) {
      for (const auto& written : form->items) items.push_back(item_of(stage.name, written));
    }
    if (const auto* after = std::get_if<experiments::PostExperiment>(&stage.content)) {
      for (const experiments::PostExperimentItem& written : after->items) {
        items.push_back({.stage = stage.name,
                         .name = written.name,
                         .kind = written.answer,
                         .question = in_spoken_language(written.question)});
      }
    }
  });
  return items;
}

std::vector<QuestionnaireItem> participant_fields(const experiments::Study& study) {
  std::vector<QuestionnaireItem> fields;
  for (const experiments::ParticipantField& written : study.participant_fields) {
    fields.push_back({.stage = kFieldsStage,
                      .name = written.name,
                      .kind = "choice",
                      .question = in_spoken_language(written.question)});
    add_options(fields.back(), written.options);
  }
  return fields;
}

void merge_items(std::vector<QuestionnaireItem>& items, std::vector<QuestionnaireItem> added) {
  for (QuestionnaireItem& one : added) {
    const auto known = std::ranges::find_if(items, [&](const QuestionnaireItem& other) {
      return other.stage == one.stage && other.name == one.name;
    });
    if (known == items.end()) {
      items.push_back(std::move(one));
    } else {
      *known = std::move(one);
    }
  }
}

std::vector<std::string> answers_by_time(const std::vector<core::AnswerRow>& answers,
                                         const QuestionnaireItem& item) {
  // Where the stage came in each session.
  std::map<std::int64_t, std::set<std::optional<std::int64_t>>> places;
  for (const core::AnswerRow& row : answers) {
    if (row.stage == item.stage) places[row.session].insert(row.stage_index);
  }
  std::vector<std::string> by_time;
  for (const core::AnswerRow& row : answers) {
    if (row.stage != item.stage || row.item != item.name) continue;
    const auto& of_session = places[row.session];
    const auto time = static_cast<std::size_t>(
        std::distance(of_session.begin(), of_session.find(row.stage_index)));
    if (time >= by_time.size()) by_time.resize(time + 1);
    if (!row.answer.empty()) by_time[time] = row.answer;
  }
  return by_time;
}

}  // namespace jnd::analysis
