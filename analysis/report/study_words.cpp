#include "analysis/report/study_words.h"

#include <algorithm>

#include "analysis/data/json_fields.h"
#include "analysis/data/quantity_unit.h"

namespace jnd::analysis {
namespace {

using nlohmann::json;

void collect(const json& list, StudyWords& words);

std::vector<double> numbers_of(const json& value) {
  std::vector<double> numbers;
  if (value.is_number()) numbers.push_back(value.get<double>());
  if (!value.is_array()) return numbers;
  for (const json& one : value) {
    if (one.is_number()) numbers.push_back(one.get<double>());
  }
  return numbers;
}

double number_in(const json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : 0.0;
}

void collect_practice(const json& block, StudyWords& words) {
  const auto practice = block.find("practice");
  if (practice == block.end() || !practice->is_object()) return;
  const auto feedback = block.find("feedback");
  PracticeWords found{
      .block = text_at(block, "name"),
      .procedure = text_at(block, "procedure"),
      .task = text_at(block, "task"),
      .interval_order = text_at(block, "interval_order"),
      .min_correct_ratio = number_in(*practice, "min_correct_ratio"),
      .num_trials_judged = static_cast<int>(number_in(*practice, "num_trials_judged")),
      .max_trials = static_cast<int>(number_in(*practice, "max_trials")),
      .feedback = feedback != block.end() && feedback->is_boolean() && feedback->get<bool>()};
  if (found.task.empty()) found.task = "reminder";
  // A quantity is the key of the levels, and of anything else about them with a word before it.
  for (const char* quantity : {"scale", "viscosity_pa_s", "stiffness_n_per_m"}) {
    const std::string reference = std::string("reference_") + quantity;
    const std::string start = std::string("start_") + quantity;
    const std::string lowest = std::string("lowest_") + quantity;
    const bool is_its = std::ranges::any_of(
        std::initializer_list<std::string>{quantity, reference, start, lowest},
        [&](const std::string& key) { return block.contains(key); });
    if (!is_its) continue;
    found.quantity = quantity;
    if (block.contains(quantity)) found.levels = numbers_of(block[quantity]);
    if (block.contains(reference)) found.references = numbers_of(block[reference]);
  }
  words.practice.push_back(std::move(found));
}

void collect_stage(const json& stage, StudyWords& words) {
  if (!stage.is_object()) return;
  const std::string name = text_at(stage, "name");
  const std::string title = text_at(stage, "title");
  if (!name.empty() && !title.empty()) words.titles.emplace(name, title);
  const std::string question = text_at(stage, "question");
  if (!name.empty() && !question.empty()) words.questions.emplace(name, question);
  collect_practice(stage, words);
  for (const char* key : {"stages", "items", "arms", "between"}) {
    if (stage.contains(key)) collect(stage[key], words);
  }
}

void collect(const json& list, StudyWords& words) {
  if (!list.is_array()) return;
  for (const json& stage : list) collect_stage(stage, words);
}

}  // namespace

std::string in_words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string StudyWords::title_of(const std::string& block) const {
  const auto found = titles.find(block);
  return found == titles.end() ? in_words(block) : found->second;
}

std::string StudyWords::short_title_of(const std::string& block) const {
  const std::string whole = title_of(block);
  return whole.substr(0, whole.find(": "));
}

StudyWords study_words_of(const std::string& protocol_text) {
  StudyWords words;
  const json study = json::parse(protocol_text, nullptr, /*allow_exceptions=*/false);
  if (!study.is_object()) return words;
  words.title = text_at(study, "title");
  if (words.title.empty()) words.title = in_words(text_at(study, "name"));
  words.description = text_at(study, "description");
  words.citation = text_at(study, "citation");
  words.blinding = text_at(study, "blinding");
  if (const auto authors = study.find("authors");
      authors != study.end() && authors->is_array()) {
    for (const json& author : *authors) {
      if (author.is_string()) words.authors.push_back(author.get<std::string>());
    }
  }
  if (const auto stages = study.find("stages"); stages != study.end()) collect(*stages, words);
  return words;
}

std::string quantity_words(const std::string& quantity) {
  if (quantity == "scale") return "scaling factor";
  if (quantity == "viscosity_pa_s") return "viscosity";
  if (quantity == "stiffness_n_per_m") return "stiffness";
  return in_words(quantity);
}

std::string quantity_axis(const std::string& quantity) {
  std::string words = quantity_words(quantity);
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z') {
    words[0] = static_cast<char>(words[0] - 'a' + 'A');
  }
  const std::string unit = quantity_unit(quantity);
  return unit.empty() ? words : words + " [" + unit + "]";
}

std::string procedure_words(const std::string& procedure, const std::string& task,
                            const std::string& interval_order) {
  std::string words = in_words(procedure);
  if (procedure == "constant_stimuli") words = "method of constant stimuli";
  if (procedure == "limits") words = "method of limits";
  if (procedure == "matching") return "matching by the method of adjustment";
  if (procedure == "quest_plus") words = "QUEST+ (Watson 2017)";
  if (task == "yes_no") return words + " as a yes-no task";
  const std::string order =
      interval_order == "balanced" ? " (order balanced)" : " (order drawn)";
  if (task == "two_interval") return words + " as a two-interval task" + order;
  if (task == "same_different") return words + " as a same-different task" + order;
  if (procedure != "constant_stimuli") return words;
  return words + " as a reminder task (reference first, yes or no)";
}

}  // namespace jnd::analysis
