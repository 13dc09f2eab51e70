// Treats every shipped study as its author would: checks, plans, simulates and analyses it.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/places.h"
#include "support/program.h"
#include "support/sanitizer.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace shipped_studies_run_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

std::vector<std::string> shipped_names() {
  std::vector<std::string> names;
  for (const auto& entry :
       fs::directory_iterator(test_support::source_folder() / "protocols")) {
    const fs::path name = entry.path().filename();
    if (name.extension() == ".json" && !name.string().ends_with(".schema.json")) {
      names.push_back(name.stem());
    }
  }
  return names;
}

class ShippedStudyTest : public ::testing::TestWithParam<std::string> {
 protected:
  ProgramOutcome jnd(const std::vector<std::string>& arguments) {
    return test_support::run_program(arguments,
                                     {.folder = temporary_.path(), .environment = {}});
  }
  test_support::TemporaryFolder temporary_{test_support::memory_folder()};
};

/// Expects that every null value is accompanied by a reason.
void expect_reasons(const nlohmann::json& results) {
  for (const auto& section : results["sections"]) {
    for (const char* list : {"estimates", "participants"}) {
      for (const auto& one : section[list]) {
        if (!one["value"].is_null()) continue;
        EXPECT_NE(one["reason"], "") << section["name"] << " " << one;
      }
    }
    for (const auto& one : section["comparisons"]) {
      if (one["status"] == "ok" && !one["p_value"].is_null()) continue;
      EXPECT_NE(one["reason"], "") << section["name"] << " " << one;
    }
  }
}

TEST_P(ShippedStudyTest, IsCheckedPlannedSimulatedVerifiedAndAnalysed) {
  const std::string& name = GetParam();
  ProgramOutcome outcome = jnd({"validate", name, "--device", "lumped"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  outcome = jnd({"plan", name, "--participants", "20", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto plan = nlohmann::json::parse(outcome.out);
  EXPECT_EQ(plan["participants"].size(), 20U);
  for (const auto& block : plan["durations"]["trials"]) {
    EXPECT_LE(block["felt_s"]["mean"], block["expected_trial_s"]) << block["block"];
  }
  if (test_support::kIsSanitized && name != "short_tour") {
    GTEST_SKIP() << "minutes of the same code";
  }
  outcome = jnd({"simulate", name, "--participants", "4", "--study", "a.study", "--fast"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  outcome = jnd({"verify", "a.study", "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  outcome = jnd({"results", "a.study", "--resamples", "100", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto results = nlohmann::json::parse(outcome.out);
  EXPECT_FALSE(results["sections"].empty());
  expect_reasons(results);
}

INSTANTIATE_TEST_SUITE_P(All, ShippedStudyTest, ::testing::ValuesIn(shipped_names()),
                         [](const auto& one) { return one.param; });

}  // namespace shipped_studies_run_test
}  // namespace jnd::app
