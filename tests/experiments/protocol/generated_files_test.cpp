#include <gtest/gtest.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "experiments/protocol/reference_writer.h"
#include "experiments/protocol/schema_writer.h"
#include "support/files.h"
#include "support/places.h"

namespace jnd::experiments {
namespace generated_files_test {

std::string shipped(const std::string& name) {
  return test_support::read_file(test_support::source_folder() / "protocols" / name);
}

// This uses EXPECT_TRUE, as EXPECT_EQ would print both files.
TEST(GeneratedFiles, TheShippedSchemaIsThatOfTheTables) {
  EXPECT_TRUE(shipped(kSchemaFileName) == study_schema())
      << "the tables changed; renew it: build/jnd schema > protocols/" << kSchemaFileName;
}

TEST(GeneratedFiles, TheShippedReferenceIsThatOfTheTables) {
  EXPECT_TRUE(shipped("README.md") == study_reference())
      << "the tables changed; renew it: build/jnd schema --markdown > protocols/README.md";
}

/// Calls `told` with the key of every property in a schema.
void for_each_property(const nlohmann::json& schema,
                       const std::function<void(const std::string&)>& told) {
  if (!schema.is_structured()) return;
  for (const auto& [key, value] : schema.items()) {
    if (key == "properties" && value.is_object()) {
      for (const auto& property : value.items()) told(property.key());
    }
    for_each_property(value, told);
  }
}

TEST(GeneratedFiles, TheDictionaryOfTheFuzzerHasEveryKeyOfTheSchema) {
  const std::string dictionary = test_support::read_file(test_support::source_folder() /
                                                         "tests/fuzz/dictionaries/study.dict");
  for_each_property(nlohmann::json::parse(study_schema()), [&](const std::string& key) {
    EXPECT_NE(dictionary.find(R"("\")" + key + R"(\"")"), std::string::npos)
        << "tests/fuzz/dictionaries/study.dict lacks " << key;
  });
}

}  // namespace generated_files_test
}  // namespace jnd::experiments
