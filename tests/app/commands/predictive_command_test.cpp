#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/data/study_data.h"
#include "analysis/results/person_outcome.h"
#include "analysis/results/published.h"
#include "analysis/results/published_statistics.h"
#include "analysis/results/study_results.h"
#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/shortened_study.h"
#include "app/tiny_study.h"
#include "core/storage/study_store.h"
#include "support/places.h"
#include "support/program.h"
#include "support/sanitizer.h"

namespace jnd::app {
namespace predictive_command_test {

namespace fs = std::filesystem;

class PredictiveCommandTest : public CommandTest {};

/// If one of our estimates has a published name, it equals the published statistic.
TEST_F(PredictiveCommandTest, OurEstimatesOfPublishedNamesAreThePublishedStatistics) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  int num_compared = 0;
  for (const std::string study : {"magnitude_of_virtual_water", "viscosity_discrimination"}) {
    const fs::path folder = temporary_.path() / (study + ".study");
    ASSERT_EQ(
        jnd({"simulate", study, "--participants", "4", "--fast", "--study", folder.string()})
            .exit_code,
        0);
    const core::StudyStore store(folder, core::StudyStore::Mode::kReadOnly);
    const analysis::StudyData data = analysis::load_study(store);
    const analysis::Published published =
        analysis::published_for(study, test_support::source_folder() / "data" / "published");
    const analysis::StudyResults results =
        analysis::results_of(data, published, {.num_resamples = 100});
    const std::vector<analysis::PersonOutcome> people = analysis::person_outcomes(data);
    analysis::PublishedStatistics statistics(people);
    for (const auto& [name, value] : published.values) {
      if (!value.compute) continue;
      const analysis::Estimate* const estimate = results.find(name);
      ASSERT_NE(estimate, nullptr) << name;
      EXPECT_EQ(estimate->published, value.value) << name;
      const auto found = statistics.value(*value.compute, {0, 1, 2, 3});
      ASSERT_TRUE(found) << name;
      if (!std::isfinite(*found)) continue;
      ASSERT_TRUE(estimate->value) << name;
      EXPECT_NEAR(*estimate->value, *found, 1e-6 * (1.0 + std::abs(*found))) << name;
      ++num_compared;
    }
  }
  EXPECT_GE(num_compared, 26);
}

TEST_F(PredictiveCommandTest, OfAnotherLaboratoryPeopleAreSimulatedWhereThatIsAskedFor) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  nlohmann::json laboratory = nlohmann::json::parse(
      read_file(test_support::source_folder() / "data" / "laboratories" / "thesis.json"));
  laboratory["name"] = "mine";
  write_file(temporary_.path() / "mine.json", laboratory.dump());
  write_file(temporary_.path() / "short.json",
             shortened_study(
                 test_support::source_folder() / "protocols/viscosity_discrimination.json", 2));
  ASSERT_EQ(jnd({"simulate", "short.json", "--participants", "2", "--fast", "--laboratory",
                 "mine.json", "--study", "v.study"})
                .exit_code,
            0);
  const auto without =
      document(jnd({"results", "v.study", "--resamples", "100", "--json"}).out);
  EXPECT_EQ(without["predictive"]["num_studies"], 0);
  EXPECT_NE(without["predictive"]["reason"].get<std::string>().find("--predictive"),
            std::string::npos);
  fs::create_directory(temporary_.path() / "kept");
  const test_support::ProgramOutcome outcome =
      jnd({"results", "v.study", "--resamples", "100", "--json", "--predictive", "52",
           "--predictive-out", "kept"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto with = document(outcome.out);
  EXPECT_EQ(with["predictive"]["num_people"], 52);
  EXPECT_EQ(with["predictive"]["num_studies"], 1000);
  EXPECT_TRUE(fs::exists(temporary_.path() / "kept" / "mine-viscosity_discrimination.json"));
  int num_with_tail = 0;
  for (const auto& section : with["sections"]) {
    for (const auto& estimate : section["estimates"]) {
      num_with_tail += estimate["predictive_p"].is_number() ? 1 : 0;
    }
  }
  EXPECT_EQ(num_with_tail, 14);
}

TEST_F(PredictiveCommandTest, ANumberThatIsNoneIsRefusedBeforeAnythingIsSimulated) {
  write_file(temporary_.path() / "tiny.json", kTinyStudy);
  ASSERT_EQ(
      jnd({"simulate", "tiny.json", "--participants", "1", "--fast", "--study", "t.study"})
          .exit_code,
      0);
  for (const char* wrong : {"0", "51", "many", "-3"}) {
    const test_support::ProgramOutcome outcome =
        jnd({"results", "t.study", "--predictive=" + std::string(wrong)});
    EXPECT_EQ(outcome.exit_code, 2) << wrong << outcome.out;
    EXPECT_NE(outcome.err.find("--predictive: expected a whole number from 52"),
              std::string::npos)
        << outcome.err;
  }
}

}  // namespace predictive_command_test
}  // namespace jnd::app
