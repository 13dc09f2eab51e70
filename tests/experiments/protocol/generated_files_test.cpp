#include <gtest/gtest.h>

#include <filesystem>
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

// EXPECT_TRUE is used because EXPECT_EQ would print both files.
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
