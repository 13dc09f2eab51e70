#include <gtest/gtest.h>

#include "app/json_document.h"
#include "app/results/results_output.h"
#include "app/tiny_study.h"
#include "support/places.h"
#include "support/program.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace demo_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

TEST(DemoCommand, RunsBothStudiesAndOverwritesNothing) {
  const test_support::TemporaryFolder temporary(test_support::memory_folder());
  const test_support::ProgramOptions options{.folder = temporary.path(), .environment = {}};
  const ProgramOutcome outcome =
      test_support::run_program({"demo", "--fast", "--json"}, options);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto json = document(outcome.out);
  ASSERT_EQ(json["studies"].size(), 2U);
  for (const auto& study : json["studies"]) {
    EXPECT_EQ(study["num_participants"], 13);
    EXPECT_EQ(study["predictive"]["num_studies"], 1000) << study["predictive"];
    EXPECT_EQ(study["predictive"]["num_participants"], 13);
    EXPECT_TRUE(study["predictive"]["joint"]["p_value"].is_number());
  }
  EXPECT_EQ(json["out"], "demo-1");
  for (const char* study : {"magnitude_of_virtual_water", "viscosity_discrimination"}) {
    const fs::path folder = temporary.path() / "demo-1" / (std::string(study) + ".study");
    EXPECT_TRUE(fs::exists(folder / "study.sqlite")) << study;
    EXPECT_EQ(test_support::run_program({"verify", folder.string()}).exit_code, 0) << study;
  }
  // A page of the manual shows the output of this very run.
  constexpr const char* kPage = "docs/explanation/demonstration.md";
  const std::string page = read_file(test_support::source_folder() / kPage);
  for (const char* study : {"magnitude_of_virtual_water", "viscosity_discrimination"}) {
    const fs::path folder = temporary.path() / "demo-1" / (std::string(study) + ".study");
    const std::string table = to_comparison_table(results_of_folder(folder));
    EXPECT_NE(page.find(table), std::string::npos) << "expected " << kPage << " to show\n"
                                                   << table;
  }
  const ProgramOutcome again =
      test_support::run_program({"demo", "--fast", "--out", "demo-1"}, options);
  EXPECT_EQ(again.exit_code, 2);
  EXPECT_NE(again.err.find("nothing is ever overwritten"), std::string::npos) << again.err;
}

}  // namespace demo_test
}  // namespace jnd::app
