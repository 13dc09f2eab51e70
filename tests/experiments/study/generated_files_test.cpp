#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "experiments/study/reference_writer.h"
#include "experiments/study/schema_writer.h"
#include "support/places.h"

namespace jnd::experiments {
namespace generated_files_test {

std::string shipped(const std::string& name) {
  std::ifstream stream(test_support::source_folder() / "protocols" / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// EXPECT_TRUE, for EXPECT_EQ would print both files.
TEST(GeneratedFiles, TheShippedSchemaIsThatOfTheTables) {
  EXPECT_TRUE(shipped(kSchemaFileName) == study_schema())
      << "the tables changed; renew it: build/jnd schema > protocols/" << kSchemaFileName;
}

TEST(GeneratedFiles, TheShippedReferenceIsThatOfTheTables) {
  EXPECT_TRUE(shipped("README.md") == study_reference())
      << "the tables changed; renew it: build/jnd schema --markdown > protocols/README.md";
}

}  // namespace generated_files_test
}  // namespace jnd::experiments
