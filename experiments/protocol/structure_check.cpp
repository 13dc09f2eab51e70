#include "experiments/protocol/structure_check.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "experiments/protocol/stage_tables.h"
#include "experiments/protocol/study_table.h"
#include "experiments/study/shown_text.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

enum class Holds { kYes, kNo, kUnknown };

/// Returns the word at this key, or the default of an absent key.
std::optional<std::string> decided(const json& object, const std::string& key,
                                   const Parameter* parameter) {
  const auto found = object.find(key);
  if (found != object.end()) {
    return found->is_string() ? std::optional(found->get<std::string>()) : std::nullopt;
  }
  if (parameter == nullptr || parameter->default_json.empty()) return std::nullopt;
  return json::parse(parameter->default_json).get<std::string>();
}

/// Whether a key belongs in this object. Unknown while the key on which it depends is itself
/// wrong, so that one mistake is reported once.
Holds belongs(const Parameter& parameter, const json& object, const ParameterTable& table) {
  Holds all = Holds::kYes;
  for (const Condition& condition : parameter.only_where) {
    const Parameter* decider = table.find(condition.key);
    const std::optional<std::string> found = decided(object, condition.key, decider);
    const bool is_sound = found && decider != nullptr &&
                          std::find(decider->allowed.begin(), decider->allowed.end(), *found) !=
                              decider->allowed.end();
    if (!is_sound) {
      if (all == Holds::kYes) all = Holds::kUnknown;
    } else if (std::find(condition.values.begin(), condition.values.end(), *found) ==
               condition.values.end()) {
      all = Holds::kNo;
    }
  }
  return all;
}

/// Two keys for the same purpose, of which each procedure has one.
constexpr std::pair<const char*, const char*> kCounterparts[] = {
    {"catch_trials", "catch_probability"}, {"catch_probability", "catch_trials"}};

/// Returns what the author probably wants who writes this key where it does not belong.
std::string counterpart_hint(const std::string& key, const json& object,
                             const ParameterTable& table) {
  for (const auto& [of, counterpart] : kCounterparts) {
    const Parameter* parameter = key == of ? table.find(counterpart) : nullptr;
    if (parameter == nullptr || belongs(*parameter, object, table) != Holds::kYes) continue;
    return std::string("; here the key is `") + counterpart + '`';
  }
  return "";
}

std::string misplaced(const Parameter& parameter, const json& object,
                      const ParameterTable& table) {
  std::string wanted, found;
  for (const Condition& condition : parameter.only_where) {
    const std::optional<std::string> value =
        decided(object, condition.key, table.find(condition.key));
    if (!value || std::find(condition.values.begin(), condition.values.end(), *value) !=
                      condition.values.end()) {
      continue;
    }
    if (!wanted.empty()) {
      wanted += " and ";
      found += " and ";
    }
    wanted += '`' + condition.key + "` is " + one_of_words(condition.values);
    found += '`' + condition.key + "` is `" + shown_text(*value) + '`';
  }
  return "expected this key only where " + wanted + ", found it where " + found +
         counterpart_hint(parameter.key, object, table);
}

bool is_language(std::string_view code) {
  return (code.size() == 2 || code.size() == 3) &&
         std::all_of(code.begin(), code.end(), [](char c) { return c >= 'a' && c <= 'z'; });
}

/// Returns a hint for a single value in the place of a list, because the author may not know
/// how lists are written.
std::string list_hint(const json& value, const Parameter& parameter) {
  const ValueKind kind = parameter.kind;
  const bool is_one = (kind == ValueKind::kNumbers && value.is_number()) ||
                      (kind == ValueKind::kStrings && value.is_string()) ||
                      ((kind == ValueKind::kTexts || kind == ValueKind::kObjects ||
                        kind == ValueKind::kStages) &&
                       value.is_object() && !value.empty());
  return is_one ? "; put it in brackets: [...]" : "";
}

/// Whether the value is a stage in the place of an arm, which contains stages.
bool is_stage(const json& value) {
  return value.is_object() && value.contains("kind") && !value.contains("stages");
}

bool is_blank(const std::string& text) {
  return text.find_first_not_of(" \t\r\n") == std::string::npos;
}

}  // namespace

std::string found_words(const json& value) {
  if (value.is_string()) {
    const auto text = value.get<std::string>();
    return text.empty() ? "an empty text" : "the text \"" + shown_text(text) + '"';
  }
  if (value.is_array()) {
    return value.empty() ? "an empty list" : "a list of " + std::to_string(value.size());
  }
  if (value.is_object()) return value.empty() ? "an empty object" : "an object";
  return value.dump();
}

bool is_name(std::string_view text) noexcept {
  constexpr std::size_t kLongest = 64;
  return !text.empty() && text.size() <= kLongest &&
         std::all_of(text.begin(), text.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

StructureCheck::StructureCheck(const LocatedJson& file, std::vector<StudyProblem>& problems)
    : StructureCheck(file, problems, all_tables()) {}

void StructureCheck::run() {
  read_languages();
  check_object(file_.root(), "", whole_file());
}

/// Returns a hint for the name of a file, because the author expects it to be read. A study
/// takes nothing from other files.
std::string StructureCheck::file_hint(const json& value) const {
  if (!value.is_string()) return "";
  const auto text = value.get<std::string>();
  if (!text.ends_with(".json") && !text.ends_with(".csv")) return "";
  std::string kind = whole_file().name;
  std::ranges::replace(kind, '_', ' ');
  return "; a " + kind + " takes nothing from other files, write it here";
}

/// Returns where a key belongs that this table lacks, if exactly one other table has it.
std::string StructureCheck::home_hint(const std::string& key) const {
  const ParameterTable* home = nullptr;
  for (const ParameterTable* table : tables_) {
    if (table->find(key) == nullptr) continue;
    if (home != nullptr) return "";
    home = table;
  }
  if (home == nullptr) return "";
  return "; `" + key + "` is a key of `" + home->name + '`' +
         (home == &whole_file() ? " (the whole file)" : "");
}

void StructureCheck::read_languages() {
  const json& root = file_.root();
  const Parameter* key = whole_file().find("languages");
  if (!root.is_object() || key == nullptr) return;
  const auto found = root.find(key->key);
  if (found == root.end() || !found->is_array()) return;
  if (found->size() > key->max_items) return;
  std::vector<std::string> languages;
  for (std::size_t i = 0; i < found->size(); ++i) {
    const json& code = (*found)[i];
    const std::string pointer = "/languages/" + std::to_string(i);
    if (!code.is_string()) return;
    if (!is_language(code.get<std::string>())) {
      report(pointer,
             "expected a code of two or three lower-case letters such as `en`, found " +
                 found_words(code));
      return;
    }
    if (std::find(languages.begin(), languages.end(), code) != languages.end()) {
      report(pointer, "expected each language once, found `" + code.get<std::string>() +
                          "` a second time");
      return;
    }
    languages.push_back(code);
  }
  languages_ = std::move(languages);
}

void StructureCheck::check_object(const json& object, const std::string& pointer,
                                  const ParameterTable& table) {
  if (!object.is_object()) {
    report(pointer, "expected an object, found " + found_words(object) + file_hint(object));
    return;
  }
  check_keys(object, pointer, table);
  for (const Parameter& parameter : table.parameters) {
    const auto found = object.find(parameter.key);
    const Holds holds = belongs(parameter, object, table);
    const std::string child = pointer + '/' + pointer_token(parameter.key);
    if (found == object.end()) {
      if (parameter.required && holds == Holds::kYes) {
        report(child, "expected " + expectation(parameter) + ", found nothing");
      }
    } else if (holds == Holds::kNo) {
      report_key(child, misplaced(parameter, object, table));
    } else {
      check_value(*found, child, parameter);
    }
  }
}

void StructureCheck::check_keys(const json& object, const std::string& pointer,
                                const ParameterTable& table) {
  std::vector<std::string> candidates = {"comment"}, present;
  for (const Parameter& parameter : table.parameters) {
    if (belongs(parameter, object, table) == Holds::kNo) continue;
    (object.contains(parameter.key) ? present : candidates).push_back(parameter.key);
  }
  // An author who writes a key twice, once misspelt, has to learn which one is read.
  const auto meant = [&](const std::string& key) {
    std::string hint = did_you_mean(key, candidates);
    if (!hint.empty()) return hint;
    const std::string nearest = nearest_word(key, present);
    return nearest.empty()
               ? ""
               : "; did you mean `" + nearest + "`, which is there already? take this one out";
  };
  for (const auto& [key, value] : object.items()) {
    if (problems_.size() > kMostProblems) return;
    const std::string child = pointer + '/' + pointer_token(key);
    if (key == "comment") {
      check_value(value, child, comment_parameter());
    } else if (table.find(key) == nullptr) {
      const std::string home = home_hint(key);
      report_key(child, "expected a key of `" + table.name + "`, found the unknown key `" +
                            shown_text(key) + "`" + (home.empty() ? meant(key) : home) +
                            file_hint(value));
    }
  }
}

void StructureCheck::check_value(const json& value, const std::string& pointer,
                                 const Parameter& parameter) {
  const auto expect = [&](bool holds) {
    if (!holds) {
      report(pointer, "expected " + expectation(parameter) + ", found " + found_words(value) +
                          list_hint(value, parameter) + file_hint(value));
    }
    return holds;
  };
  switch (parameter.kind) {
    case ValueKind::kString:
    case ValueKind::kName:
      return check_string(value, pointer, parameter);
    case ValueKind::kText:
      return check_text(value, pointer);
    case ValueKind::kNumber:
    case ValueKind::kInteger:
      return check_number(value, pointer, parameter);
    case ValueKind::kBoolean:
      expect(value.is_boolean());
      return;
    case ValueKind::kDate:
      return check_date(value, pointer, parameter);
    case ValueKind::kMeasured:
      if (expect(value.is_object())) check_measured(value, pointer, parameter);
      return;
    case ValueKind::kObject:
      return check_object(value, pointer, *parameter.nested);
    case ValueKind::kArms:
    case ValueKind::kLevels:
      if (expect(value.is_object() && !value.empty())) check_arms(value, pointer);
      return;
    case ValueKind::kWeights:
      if (expect(value.is_object() && !value.empty())) check_weights(value, pointer);
      return;
    case ValueKind::kNumbers:
    case ValueKind::kStrings:
    case ValueKind::kTexts:
    case ValueKind::kObjects:
    case ValueKind::kStages:
      if (expect(value.is_array() && value.size() >= parameter.min_items &&
                 (parameter.min_items != parameter.max_items ||
                  value.size() == parameter.max_items))) {
        check_list(value, pointer, parameter);
      }
      return;
  }
}

void StructureCheck::check_string(const json& value, const std::string& pointer,
                                  const Parameter& parameter) {
  if (parameter.may_be_empty && value.is_string() && value.get<std::string>().empty()) return;
  const bool is_text = value.is_string() && !is_blank(value.get<std::string>());
  const std::string text = is_text ? value.get<std::string>() : "";
  const auto& allowed = parameter.allowed;
  const bool is_allowed =
      allowed.empty() || std::find(allowed.begin(), allowed.end(), text) != allowed.end();
  const bool is_well_named = parameter.kind != ValueKind::kName || is_name(text);
  if (is_text && is_allowed && is_well_named) return;
  const std::string found =
      is_text && !allowed.empty() ? '`' + shown_text(text) + '`' : found_words(value);
  report(pointer, "expected " + expectation(parameter) + ", found " + found +
                      (is_text ? did_you_mean(text, allowed) : ""));
}

void StructureCheck::check_number(const json& value, const std::string& pointer,
                                  const Parameter& parameter) {
  const bool whole = parameter.kind == ValueKind::kInteger;
  const bool is_right_kind = whole ? value.is_number_integer() : value.is_number();
  if (is_right_kind && parameter.range.contains(value.get<double>())) return;
  report(pointer,
         "expected " + number_expectation(parameter) + ", found " + found_words(value));
}

void StructureCheck::check_date(const json& value, const std::string& pointer,
                                const Parameter& parameter) {
  if (value.is_string() && is_date(value.get<std::string>())) return;
  report(pointer, "expected " + expectation(parameter) + ", found " + found_words(value));
}

void StructureCheck::check_measured(const json& value, const std::string& pointer,
                                    const Parameter& parameter) {
  const std::size_t num_before = problems_.size();
  check_object(value, pointer, measured_table(parameter));
  if (problems_.size() > num_before) return;
  const double measured = value.at("value").get<double>();
  const double low = value.at("ci95").at(0).get<double>();
  const double high = value.at("ci95").at(1).get<double>();
  if (low <= measured && measured <= high) return;
  report(pointer + "/ci95",
         "expected the lower and the upper end of an interval around `value` (" +
             plain_number(measured) + "), found " + plain_number(low) + " to " +
             plain_number(high));
}

void StructureCheck::check_text(const json& value, const std::string& pointer) {
  if (!value.is_object()) {
    const std::string language = languages_.empty() ? "en" : languages_.front();
    const std::string shown = value.is_string() ? shown_text(value.get<std::string>()) : "...";
    report(pointer, "expected a text by language such as {\"" + language + "\": \"" + shown +
                        "\"}, found " + found_words(value));
    return;
  }
  for (const auto& [language, words] : value.items()) {
    const std::string child = pointer + '/' + pointer_token(language);
    if (language == "comment") {
      check_value(words, child, comment_parameter());
    } else if (!is_language(language)) {
      report_key(child,
                 "expected a language code such as `en`, found `" + shown_text(language) + "`");
    } else if (!words.is_string() || is_blank(words.get<std::string>())) {
      report(child, "expected a text in quotes, found " + found_words(words));
    } else if (!languages_.empty() &&
               std::find(languages_.begin(), languages_.end(), language) == languages_.end()) {
      report_key(child, "expected one of the study's `languages` (" + one_of_words(languages_) +
                            "), found `" + language + "`");
    }
  }
  for (const std::string& language : languages_) {
    if (!value.contains(language)) {
      report(pointer + '/' + language,
             "expected the text in `" + language + "` too, as `languages` says, found nothing");
    }
  }
}

void StructureCheck::check_list(const json& list, const std::string& pointer,
                                const Parameter& parameter) {
  if (list.size() > parameter.max_items) {
    report(pointer, "expected a list of at most " + std::to_string(parameter.max_items) +
                        ", found " + found_words(list));
    return;
  }
  for (std::size_t i = 0; i < list.size(); ++i) {
    const std::string child = pointer + '/' + std::to_string(i);
    switch (parameter.kind) {
      case ValueKind::kNumbers:
        check_number(list[i], child, parameter);
        break;
      case ValueKind::kStrings:
        check_string(list[i], child, {.key = parameter.key});
        break;
      case ValueKind::kTexts:
        check_text(list[i], child);
        break;
      case ValueKind::kStages:
        check_stage(list[i], child, parameter.allowed);
        break;
      default:
        if (parameter.nested == &arm_table() && is_stage(list[i])) {
          report(child,
                 R"(expected an arm, {"name": ..., "stages": [...]}, found a stage; put it )"
                 "into the `stages` of an arm");
          break;
        }
        check_object(list[i], child, *parameter.nested);
    }
  }
}

void StructureCheck::check_stage(const json& stage, const std::string& pointer,
                                 const std::vector<std::string>& allowed) {
  if (!stage.is_object()) {
    report(pointer, "expected a stage, an object with `kind`, found " + found_words(stage));
    return;
  }
  std::vector<std::string> kinds = allowed;
  for (const ParameterTable* table : stage_tables()) {
    if (allowed.empty()) kinds.push_back(table->name);
  }
  const auto kind = stage.find("kind");
  const Parameter any_kind = {.key = "kind", .allowed = kinds};
  if (kind == stage.end()) {
    report(pointer + "/kind", "expected " + expectation(any_kind) + ", found nothing");
  } else if (!kind->is_string() || stage_table(kind->get<std::string>()) == nullptr) {
    check_string(*kind, pointer + "/kind", any_kind);
  } else if (std::ranges::find(kinds, kind->get<std::string>()) == kinds.end()) {
    report(pointer + "/kind", "expected a stage of kind " + one_of_words(allowed) +
                                  " here, found one of kind `" + kind->get<std::string>() +
                                  "`; put it before or after the stage that this one is in");
  } else {
    check_object(stage, pointer, *stage_table(kind->get<std::string>()));
  }
}

void StructureCheck::check_arms(const json& arms, const std::string& pointer) {
  for (const auto& [counterbalance, arm] : arms.items()) {
    const std::string child = pointer + '/' + pointer_token(counterbalance);
    const Parameter name = {.key = counterbalance, .kind = ValueKind::kName};
    if (counterbalance == "comment") {
      check_value(arm, child, comment_parameter());
    } else {
      check_string(arm, child, name);
    }
  }
}

void StructureCheck::check_weights(const json& weights, const std::string& pointer) {
  const Parameter weight = {
      .key = "weight", .kind = ValueKind::kNumber, .range = {-1000.0, 1000.0}};
  for (const auto& [factor, levels] : weights.items()) {
    const std::string child = pointer + '/' + pointer_token(factor);
    if (factor == "comment") {
      check_value(levels, child, comment_parameter());
      continue;
    }
    if (!levels.is_object() || levels.empty()) {
      report(child, R"(expected levels with their weights such as {"thin": 1, "thick": -1}, )"
                    "found " +
                        found_words(levels));
      continue;
    }
    for (const auto& [level, value] : levels.items()) {
      const std::string at = child + '/' + pointer_token(level);
      if (level == "comment") {
        check_value(value, at, comment_parameter());
      } else {
        check_number(value, at, weight);
      }
    }
  }
}

void StructureCheck::report_key(const std::string& pointer, std::string message) {
  const TextPosition position = file_.key_position(pointer);
  add_problem(problems_,
              {file_.file(), position.line, position.column, pointer, std::move(message)});
}

}  // namespace jnd::experiments
