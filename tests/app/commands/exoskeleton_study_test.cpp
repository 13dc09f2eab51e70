// Runs the second study, shortened, on the simulated exoskeleton. What was observed of people's
// movement there follows from the model, because nobody put it in.

#include <gtest/gtest.h>

#include <map>
#include <string>

#include "app/json_document.h"
#include "app/shortened_study.h"
#include "app/tiny_study.h"
#include "support/places.h"
#include "support/program.h"
#include "support/sanitizer.h"
#include "support/temporary_folder.h"

namespace jnd::app {
namespace exoskeleton_study_test {

TEST(ExoskeletonStudy, TheThickFluidIsSlowerThePalmLeadsAndTheFingersFollow) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  const test_support::TemporaryFolder temporary{test_support::memory_folder()};
  write_file(temporary.path() / "short.json",
             shortened_study(
                 test_support::source_folder() / "protocols/viscosity_discrimination.json", 1));
  const auto jnd = [&](const std::vector<std::string>& words) {
    return test_support::run_program(words, {.folder = temporary.path(), .environment = {}});
  };
  const test_support::ProgramOutcome simulated =
      jnd({"simulate", "short.json", "--participants", "1", "--device", "exoskeleton",
           "--study", "a.study", "--fast"});
  ASSERT_EQ(simulated.exit_code, 0) << simulated.err;
  const test_support::ProgramOutcome results =
      jnd({"results", "a.study", "--resamples", "100", "--json"});
  ASSERT_EQ(results.exit_code, 0) << results.err;
  std::map<std::string, double> values;
  const auto told = document(results.out);
  for (const auto& section : told["sections"]) {
    for (const auto& estimate : section["estimates"]) {
      if (estimate["value"].is_number()) values[estimate["name"]] = estimate["value"];
    }
  }
  ASSERT_TRUE(values.contains("finger_lag_s.group_e")) << results.out;
  EXPECT_LT(values.at("max_speed_m_per_s.group_e"), values.at("max_speed_m_per_s.group_d"));
  EXPECT_GT(values.at("finger_lag_s.group_d"), 0.002);
  EXPECT_GT(values.at("finger_lag_s.group_e"), 0.002);
}

}  // namespace exoskeleton_study_test
}  // namespace jnd::app
