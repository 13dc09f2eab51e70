#include "experiments/protocol/schema_writer.h"

#include <algorithm>

#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "experiments/protocol/block_examples.h"
#include "experiments/protocol/located_json.h"
#include "experiments/protocol/study_table.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace {

// Keys keep the order of the tables.
using Json = nlohmann::ordered_json;

constexpr const char* kNamePattern = "^[a-z0-9_]{1,64}$";
constexpr const char* kLanguagePattern = "^[a-z]{2,3}$";
constexpr const char* kDatePattern = "^[0-9]{4}-[0-9]{2}-[0-9]{2}$";

/// Returns a schema for words with at least one visible character.
Json words_schema() { return {{"type", "string"}, {"pattern", "\\S"}}; }

Json reference(const std::string& definition) {
  return {{"$ref", "#/definitions/" + definition}};
}

Json number_schema(const Parameter& parameter) {
  Json schema = {{"type", parameter.kind == ValueKind::kInteger ? "integer" : "number"}};
  const Range& range = parameter.range;
  if (range.low == range.high) return {{"const", static_cast<int>(range.low)}};
  if (range.low > -std::numeric_limits<double>::infinity()) {
    schema[range.low_is_open ? "exclusiveMinimum" : "minimum"] = range.low;
  }
  if (range.high < std::numeric_limits<double>::infinity()) schema["maximum"] = range.high;
  return schema;
}

Json list_schema(const Parameter& parameter, Json items) {
  return {{"type", "array"},
          {"items", std::move(items)},
          {"minItems", parameter.min_items},
          {"maxItems", parameter.max_items}};
}

Json table_schema(const ParameterTable& table);

/// Returns a schema for factors, each with weights of its levels. A comment is allowed in both.
Json weights_schema() {
  const Json levels = {{"type", "object"},
                       {"minProperties", 1},
                       {"properties", {{"comment", {{"type", "string"}}}}},
                       {"additionalProperties", {{"type", "number"}}}};
  return {{"type", "object"},
          {"minProperties", 1},
          {"properties", {{"comment", {{"type", "string"}}}}},
          {"additionalProperties", levels}};
}

Json value_schema(const Parameter& parameter) {
  switch (parameter.kind) {
    case ValueKind::kString:
      if (!parameter.allowed.empty()) return {{"enum", parameter.allowed}};
      if (parameter.may_be_empty) return {{"type", "string"}};
      return words_schema();
    case ValueKind::kName:
      return {{"type", "string"},
              {"pattern", kNamePattern},
              {"patternErrorMessage", "Expected " + expectation(parameter) + "."}};
    case ValueKind::kText:
      return reference("text");
    case ValueKind::kNumber:
    case ValueKind::kInteger:
      return number_schema(parameter);
    case ValueKind::kBoolean:
      return {{"type", "boolean"}};
    case ValueKind::kDate:
      return {{"type", "string"}, {"pattern", kDatePattern}};
    case ValueKind::kMeasured:
      return table_schema(measured_table(parameter));
    case ValueKind::kNumbers:
      return list_schema(parameter, number_schema(parameter));
    case ValueKind::kStrings:
      if (parameter.key == "languages") {
        Json codes =
            list_schema(parameter, {{"type", "string"}, {"pattern", kLanguagePattern}});
        codes["uniqueItems"] = true;
        return codes;
      }
      return list_schema(parameter, words_schema());
    case ValueKind::kTexts:
      return list_schema(parameter, reference("text"));
    case ValueKind::kObject:
      return reference(parameter.nested->name);
    case ValueKind::kObjects:
      return list_schema(parameter, reference(parameter.nested->name));
    case ValueKind::kStages:
      return list_schema(
          parameter,
          reference(parameter.allowed.size() == 1 ? parameter.allowed.front() : "stage"));
    case ValueKind::kArms:
    case ValueKind::kLevels:
      return {{"type", "object"},
              {"minProperties", 1},
              {"additionalProperties", {{"type", "string"}, {"pattern", kNamePattern}}}};
    case ValueKind::kWeights:
      return weights_schema();
  }
  return {};
}

/// Returns "where `procedure` is `constant_stimuli` and `medium` is `water`".
std::string condition_words(const std::vector<Condition>& conditions) {
  std::string words;
  for (const Condition& condition : conditions) {
    words += (words.empty() ? "where `" : " and `") + condition.key + "` is " +
             one_of_words(condition.values);
  }
  return words;
}

std::string description(const Parameter& parameter) {
  std::string text = parameter.meaning;
  if (!parameter.unit.empty()) text += " Unit: " + parameter.unit + '.';
  if (!parameter.only_where.empty()) {
    text += std::string(parameter.required ? " Required" : " Allowed") + " only " +
            condition_words(parameter.only_where) + '.';
  }
  return text;
}

/// Returns what VS Code shows instead of the description: the same, and what the author can
/// write.
std::string markdown_description(const Parameter& parameter) {
  std::string text = description(parameter) + "\n\nExpected: " + expectation(parameter);
  const bool has_range = parameter.range.high < std::numeric_limits<double>::infinity();
  if (has_range && parameter.kind == ValueKind::kNumbers) {
    text += ", each " + number_expectation(parameter);
  }
  if (has_range && parameter.kind == ValueKind::kMeasured) {
    text += ", its value " + number_expectation(parameter);
  }
  if (!parameter.default_json.empty()) text += ". Default: `" + parameter.default_json + '`';
  return text + '.';
}

Json property_schema(const Parameter& parameter) {
  Json schema = value_schema(parameter);
  // Draft 7 ignores what stands beside a $ref.
  if (schema.contains("$ref")) schema = {{"allOf", Json::array({schema})}};
  Json described = {{"description", description(parameter)},
                    {"markdownDescription", markdown_description(parameter)}};
  schema.erase("description");  // The description of this key says more.
  described.update(schema);
  if (!parameter.default_json.empty()) {
    described["default"] = Json::parse(parameter.default_json);
  }
  return described;
}

/// Whether the default of an absent key is one of the condition's values.
bool holds_by_default(const ParameterTable& table, const Condition& condition) {
  const Parameter* decider = table.find(condition.key);
  if (decider == nullptr || decider->default_json.empty()) return false;
  const Json word = Json::parse(decider->default_json);
  return std::find(condition.values.begin(), condition.values.end(), word) !=
         condition.values.end();
}

/// Returns one if/then/else for each set of conditions. Its keys are described and required if
/// the conditions hold, and forbidden if they do not. So an editor offers only those that
/// belong there.
Json conditional_schemas(const ParameterTable& table) {
  std::vector<std::pair<std::string, Json>> rules;
  for (const Parameter& parameter : table.parameters) {
    if (parameter.only_where.empty()) continue;
    const std::string words = condition_words(parameter.only_where);
    Json* rule = nullptr;
    for (auto& [known, schema] : rules) {
      if (known == words) rule = &schema;
    }
    if (rule == nullptr) {
      Json condition = {{"properties", Json::object()}, {"required", Json::array()}};
      for (const Condition& one : parameter.only_where) {
        condition["properties"][one.key] = {{"enum", one.values}};
        if (!holds_by_default(table, one)) condition["required"].push_back(one.key);
      }
      rules.emplace_back(
          words, Json{{"if", condition},
                      {"then", {{"properties", Json::object()}, {"required", Json::array()}}},
                      {"else", {{"properties", Json::object()}}}});
      rule = &rules.back().second;
    }
    (*rule)["then"]["properties"][parameter.key] = property_schema(parameter);
    if (parameter.required) (*rule)["then"]["required"].push_back(parameter.key);
    (*rule)["else"]["properties"][parameter.key] = false;
  }
  Json schemas = Json::array();
  for (auto& [words, schema] : rules) schemas.push_back(std::move(schema));
  return schemas;
}

Json examples_of(const ParameterTable& table) {
  Json examples = Json::array();
  if (table.name == "block") {
    for (const BlockExample& example : block_examples()) {
      examples.push_back(Json::parse(example.json));
    }
  } else if (!table.example.empty()) {
    examples.push_back(Json::parse(table.example));
  }
  return examples;
}

Json table_schema(const ParameterTable& table) {
  Json schema = {{"description", table.meaning}, {"type", "object"}};
  if (Json examples = examples_of(table); !examples.empty()) {
    schema["examples"] = std::move(examples);
  }
  Json required = Json::array();
  Json properties = Json::object();
  for (const Parameter& parameter : table.parameters) {
    // A key that belongs here only under conditions is described by its conditional schema.
    properties[parameter.key] =
        parameter.only_where.empty() ? property_schema(parameter) : Json(true);
    if (parameter.required && parameter.only_where.empty()) required.push_back(parameter.key);
  }
  properties[comment_parameter().key] = property_schema(comment_parameter());
  schema["properties"] = std::move(properties);
  schema["required"] = std::move(required);
  schema["additionalProperties"] = false;
  if (Json rules = conditional_schemas(table); !rules.empty())
    schema["allOf"] = std::move(rules);
  return schema;
}

/// Returns whole stages that VS Code offers to insert.
Json stage_snippets() {
  Json snippets = Json::array();
  for (const ParameterTable* table : stage_tables()) {
    for (Json& example : examples_of(*table)) {
      const std::string label =
          table->name + (table->name == "block"
                             ? ": " + example.at("procedure").get<std::string>()
                             : std::string());
      snippets.push_back(
          {{"label", label}, {"description", table->meaning}, {"body", std::move(example)}});
    }
  }
  return snippets;
}

Json stage_schema() {
  std::string kinds = "One thing that happens in a session. ";
  Json names = Json::array();
  Json meanings = Json::array();
  Json rules = Json::array();
  for (const ParameterTable* table : stage_tables()) {
    names.push_back(table->name);
    meanings.push_back(table->meaning);
    kinds += '`' + table->name + "`: " + table->meaning + ' ';
    rules.push_back({{"if",
                      {{"properties", {{"kind", {{"const", table->name}}}}},
                       {"required", Json::array({"kind"})}}},
                     {"then", reference(table->name)}});
  }
  kinds.pop_back();
  return {{"description", kinds},
          {"type", "object"},
          {"defaultSnippets", stage_snippets()},
          {"properties", {{"kind", {{"enum", names}, {"markdownEnumDescriptions", meanings}}}}},
          {"required", Json::array({"kind"})},
          {"allOf", rules}};
}

}  // namespace

/// `definitions` are what the tables refer to besides each other.
static std::string schema_text(const std::vector<const ParameterTable*>& tables,
                               const std::string& title, Json definitions) {
  Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", title}};
  schema.update(table_schema(*tables.front()));
  for (const ParameterTable* table : tables) {
    if (table != tables.front()) definitions[table->name] = table_schema(*table);
  }
  schema["definitions"] = std::move(definitions);
  return schema.dump(2) + '\n';
}

std::string file_schema(const std::vector<const ParameterTable*>& tables,
                        const std::string& title) {
  return schema_text(tables, title, Json::object());
}

std::string study_schema() {
  Json definitions = {
      {"text",
       {{"description", "Words in every language of the study: language code to words."},
        {"type", "object"},
        {"examples", Json::array({{{"en", "Rest."}, {"de", "Pause."}}})},
        {"defaultSnippets", Json::array({{{"label", "text"}, {"body", {{"en", "$1"}}}}})},
        {"patternProperties", {{"^([a-z]{2,3}|comment)$", words_schema()}}},
        {"additionalProperties", false},
        {"minProperties", 1}}},
      {"stage", stage_schema()}};
  return schema_text(all_tables(), "jnd study, format 1", std::move(definitions));
}

}  // namespace jnd::experiments
