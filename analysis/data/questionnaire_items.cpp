#include "analysis/data/questionnaire_items.h"

#include <algorithm>

#include "analysis/data/json_fields.h"

namespace jnd::analysis {
namespace {

using nlohmann::json;

constexpr int kDefaultSteps = 10;  ///< What the format says of a scale without `num_steps`.

/// The objects in a list; none where there is no list.
std::vector<json> objects_at(const json& object, const char* key) {
  std::vector<json> objects;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_array()) return objects;
  std::copy_if(found->begin(), found->end(), std::back_inserter(objects),
               [](const json& one) { return one.is_object(); });
  return objects;
}

QuestionnaireItem item_of(const json& object, const std::string& stage, const char* kind_key) {
  QuestionnaireItem item{.stage = stage,
                         .name = string_at(object, "name"),
                         .kind = string_at(object, kind_key),
                         .question = text_at(object, "question"),
                         .unit = string_at(object, "unit")};
  for (const json& option : objects_at(object, "options")) {
    item.options.push_back(string_at(option, "value"));
    item.option_labels.push_back(text_at(option, "label"));
  }
  if (item.kind != "scale") return item;
  item.low_label = text_at(object, "low_label");
  item.high_label = text_at(object, "high_label");
  const auto steps = object.find("num_steps");
  item.num_steps =
      steps != object.end() && steps->is_number_integer() ? steps->get<int>() : kDefaultSteps;
  const auto good = object.find("high_is_good");
  if (good != object.end() && good->is_boolean()) item.high_is_good = good->get<bool>();
  return item;
}

void add_items(const json& stages_or_arms, const char* key,
               std::vector<QuestionnaireItem>& items) {
  for (const json& stage : objects_at(stages_or_arms, key)) {
    const std::string kind = string_at(stage, "kind");
    if (kind == "questionnaire" || kind == "post_experiment") {
      for (const json& object : objects_at(stage, "items")) {
        items.push_back(item_of(object, string_at(stage, "name"),
                                kind == "questionnaire" ? "kind" : "answer"));
      }
    }
    for (const char* nested : {"arms", "stages", "between"}) add_items(stage, nested, items);
  }
}

}  // namespace

std::vector<QuestionnaireItem> questionnaire_items(const json& protocol) {
  std::vector<QuestionnaireItem> items;
  add_items(protocol, "stages", items);
  return items;
}

std::vector<QuestionnaireItem> participant_fields(const json& protocol) {
  std::vector<QuestionnaireItem> fields;
  for (const json& object : objects_at(protocol, "participant_fields")) {
    fields.push_back(item_of(object, kFieldsStage, "kind"));
    fields.back().kind = "choice";
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

}  // namespace jnd::analysis
