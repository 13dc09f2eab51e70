#include "experiments/protocol/schema_writer.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>

#include "experiments/procedures/procedure_registry.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/protocol/study_table.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace schema_writer_test {

using nlohmann::json;

const json& schema_of(const ParameterTable& table) {
  static const json kSchema = json::parse(study_schema());
  return table.name == "study" ? kSchema : kSchema.at("definitions").at(table.name);
}

/// Returns what the schema says of a key, in the table or in the rule whose condition applies.
json property_of(const json& schema, const std::string& key) {
  const json& plain = schema.at("properties").at(key);
  if (plain.is_object()) return plain;
  for (const json& rule : schema.at("allOf")) {
    const json& then = rule.at("then").at("properties");
    if (then.contains(key)) return then.at(key);
  }
  return json::object();
}

TEST(SchemaWriter, WritesDraft7) {
  EXPECT_EQ(json::parse(study_schema()).at("$schema"),
            "http://json-schema.org/draft-07/schema#");
}

TEST(SchemaWriter, DescribesEveryKeyOfEveryTableAndAllowsNoOther) {
  for (const ParameterTable* table : all_tables()) {
    const json& schema = schema_of(*table);
    EXPECT_EQ(schema.at("additionalProperties"), false) << table->name;
    EXPECT_EQ(schema.at("properties").size(), table->parameters.size() + 1) << table->name;
    for (const Parameter& parameter : table->parameters) {
      ASSERT_TRUE(schema.at("properties").contains(parameter.key)) << parameter.key;
      EXPECT_FALSE(parameter.meaning.empty()) << parameter.key;
      const std::string description = property_of(schema, parameter.key).at("description");
      EXPECT_NE(description.find(parameter.meaning), std::string::npos) << parameter.key;
      EXPECT_NE(description.find(parameter.unit), std::string::npos) << parameter.key;
    }
    EXPECT_TRUE(schema.at("properties").contains("comment")) << table->name;
  }
}

TEST(SchemaWriter, RequiresWhatTheReaderRequires) {
  for (const ParameterTable* table : all_tables()) {
    const std::vector<std::string> required = schema_of(*table).at("required");
    for (const Parameter& parameter : table->parameters) {
      const bool listed =
          std::find(required.begin(), required.end(), parameter.key) != required.end();
      EXPECT_EQ(listed, parameter.required && parameter.only_where.empty()) << parameter.key;
    }
  }
}

TEST(SchemaWriter, GivesRangesDefaultsAndAllowedWords) {
  const json& block = schema_of(*stage_table("block"));
  EXPECT_EQ(property_of(block, "viscosity_pa_s").at("items").at("exclusiveMinimum"), 0.0);
  EXPECT_EQ(property_of(block, "free_space_between_s").at("default"), 0.0);
  EXPECT_EQ(property_of(block, "free_space_between_s").at("minimum"), 0.0);
  EXPECT_EQ(property_of(block, "procedure").at("enum").size(), procedures().size());
}

TEST(SchemaWriter, PutsKeysThatBelongTogetherIntoConditions) {
  const json& rules = schema_of(*stage_table("block")).at("allOf");
  int num_found = 0;
  for (const json& rule : rules) {
    if (!rule.at("else").at("properties").contains("reference_viscosity_pa_s")) continue;
    ++num_found;
    EXPECT_EQ(rule.at("then").at("required"), json::array({"reference_viscosity_pa_s"}));
    EXPECT_EQ(rule.at("then").at("properties").size(), 1u)
        << "an editor offers only what belongs there";
    EXPECT_EQ(rule.at("if").at("properties").at("medium").at("enum"),
              json::array({"viscous", "viscous_stokes", "viscous_sphere",
                           "viscous_schiller_naumann", "viscous_ellipsoid"}));
  }
  EXPECT_EQ(num_found, 1);
}

TEST(SchemaWriter, ResolvesEveryReference) {
  const std::string text = study_schema();
  const json schema = json::parse(text);
  const std::string start = "\"#/definitions/";
  int num_references = 0;
  for (std::size_t at = text.find(start); at != std::string::npos;
       at = text.find(start, at + 1)) {
    const std::size_t begin = at + start.size();
    EXPECT_TRUE(
        schema.at("definitions").contains(text.substr(begin, text.find('"', begin) - begin)));
    ++num_references;
  }
  EXPECT_GT(num_references, 20);
}

TEST(SchemaWriter, OffersEveryStageKindAndProcedureToBePutIn) {
  const json snippets =
      json::parse(study_schema()).at("definitions").at("stage").at("defaultSnippets");
  std::set<std::string> labels;
  for (const json& snippet : snippets) labels.insert(snippet.at("label").get<std::string>());
  for (const ParameterTable* table : stage_tables()) {
    EXPECT_TRUE(labels.contains(table->name) || table->name == "block") << table->name;
  }
  for (const std::string& procedure : stage_table("block")->find("procedure")->allowed) {
    EXPECT_TRUE(labels.contains("block: " + procedure))
        << procedure << ": add an example to experiments/protocol/block_examples.cpp";
  }
}

TEST(SchemaWriter, ShowsAnExampleOfEveryStageKindThatTheReaderTakes) {
  for (const ParameterTable* table : stage_tables()) {
    for (const json& example : schema_of(*table).at("examples")) {
      const json study = {{"format", 1},
                          {"name", "example"},
                          {"languages", {"en"}},
                          {"title", {{"en", "Example"}}},
                          {"authors", {"A. Author"}},
                          {"stages", json::array({example})}};
      for (const StudyProblem& problem : study_text_problems(study.dump(), table->name)) {
        ADD_FAILURE() << to_string(problem);
      }
    }
  }
  for (const StudyProblem& problem :
       study_text_problems(schema_of(study_table()).at("examples").at(0).dump(), "study")) {
    ADD_FAILURE() << to_string(problem);
  }
}

}  // namespace schema_writer_test
}  // namespace jnd::experiments
