#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/protocol/block_examples.h"
#include "experiments/protocol/study_reader.h"
#include "experiments/protocol/study_table.h"
#include "experiments/study/parameter_table.h"

// Tests what holds for every table, including those of later procedures.

namespace jnd::experiments {
namespace table_examples_test {

using nlohmann::json;

json study_of(const json& stage) {
  return {{"format", 1},
          {"name", "example"},
          {"languages", {"en"}},
          {"title", {{"en", "Example"}}},
          {"authors", {"A. Author"}},
          {"stages", json::array({stage})}};
}

std::vector<json> examples() {
  std::vector<json> all;
  for (const ParameterTable* stage : stage_tables()) all.push_back(json::parse(stage->example));
  for (const BlockExample& example : block_examples()) all.push_back(json::parse(example.json));
  return all;
}

/// Collects the pointers of everything in a value.
void collect(const json& value, const std::string& pointer, std::vector<std::string>& all) {
  if (!pointer.empty()) all.push_back(pointer);
  if (!value.is_structured()) return;
  for (const auto& [key, inner] : value.items()) collect(inner, pointer + '/' + key, all);
}

bool has_problem_at(const std::vector<StudyProblem>& problems, const std::string& pointer) {
  return std::any_of(problems.begin(), problems.end(),
                     [&](const StudyProblem& problem) { return problem.pointer == pointer; });
}

TEST(TableExamples, HaveNoProblem) {
  for (const json& example : examples()) {
    for (const StudyProblem& problem : study_text_problems(study_of(example).dump(), "x")) {
      ADD_FAILURE() << to_string(problem);
    }
  }
}

TEST(TableExamples, AreRefusedAtThePlaceWhereAValueIsNull) {
  for (const json& example : examples()) {
    std::vector<std::string> pointers;
    collect(example, "", pointers);
    for (const std::string& pointer : pointers) {
      json broken = example;
      broken[json::json_pointer(pointer)] = nullptr;
      EXPECT_TRUE(has_problem_at(study_text_problems(study_of(broken).dump(), "x"),
                                 "/stages/0" + pointer))
          << example.at("name") << ": " << pointer;
    }
  }
}

TEST(TableExamples, AreRefusedAtThePlaceWhereANumberIsOutOfItsRange) {
  int num_numbers = 0;
  for (const json& example : examples()) {
    for (const ParameterTable* table : all_tables()) {
      for (const Parameter& parameter : table->parameters) {
        if (!(parameter.range.high < 1e300) || !example.contains(parameter.key)) continue;
        json broken = example;
        const bool is_list = broken[parameter.key].is_array();
        (is_list ? broken[parameter.key][0] : broken[parameter.key]) =
            parameter.kind == ValueKind::kInteger ? json(1 << 30) : json(1e300);
        EXPECT_TRUE(has_problem_at(study_text_problems(study_of(broken).dump(), "x"),
                                   "/stages/0/" + parameter.key + (is_list ? "/0" : "")))
            << example.at("name") << ": " << parameter.key;
        ++num_numbers;
      }
    }
  }
  EXPECT_GT(num_numbers, 10);
}

TEST(TableExamples, AreRefusedWithAnUnknownKeyInAnyObject) {
  for (const json& example : examples()) {
    std::vector<std::string> pointers = {""};
    collect(example, "", pointers);
    for (const std::string& pointer : pointers) {
      json broken = example;
      json& object = broken[json::json_pointer(pointer)];
      if (!object.is_object()) continue;
      object["no_such_key"] = 1;
      EXPECT_TRUE(has_problem_at(study_text_problems(study_of(broken).dump(), "x"),
                                 "/stages/0" + pointer + "/no_such_key"))
          << example.at("name") << ": " << pointer;
    }
  }
}

}  // namespace table_examples_test
}  // namespace jnd::experiments
