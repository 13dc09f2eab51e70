#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/tiny_study.h"
#include "support/places.h"
#include "support/program.h"

namespace jnd::app {
namespace results_movement_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class ResultsMovementTest : public CommandTest {
 protected:
  void simulate(const std::vector<std::string>& arguments) {
    std::vector<std::string> all = {"simulate"};
    all.insert(all.end(), arguments.begin(), arguments.end());
    const ProgramOutcome outcome = jnd(all);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  nlohmann::json results(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "results");
    arguments.insert(arguments.end(), {"--resamples", "100", "--json"});
    const ProgramOutcome outcome = jnd(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return document(outcome.out);
  }
  static nlohmann::json section(const nlohmann::json& results, const std::string& name) {
    for (const auto& one : results["sections"]) {
      if (one["name"] == name) return one;
    }
    return nullptr;
  }
  /// Returns infinity if there is no value.
  static double value(const nlohmann::json& results, const std::string& name) {
    for (const auto& one : results["sections"]) {
      for (const auto& estimate : one["estimates"]) {
        if (estimate["name"] == name && estimate["value"].is_number()) {
          return estimate["value"].get<double>();
        }
      }
    }
    return std::numeric_limits<double>::infinity();
  }
};

TEST_F(ResultsMovementTest, AddsWhatTheRecordingsSayOnRequest) {
  write_file(temporary_.path() / "tiny.json", kTinyStudy);
  simulate({"tiny.json", "--participants", "2", "--study", "t.study"});
  EXPECT_TRUE(section(results({"t.study"}), "recorded_movement").is_null());
  const nlohmann::json found = results({"t.study", "--movement"});
  ASSERT_TRUE(section(found, "recorded_movement").is_object());
  EXPECT_EQ(section(found, "recorded_movement")["excluded"].size(), 0U);
  EXPECT_NEAR(value(found, "delivered_ratio.comparison"), 1.0, 0.1);
  EXPECT_GT(value(found, "hand_height_ratio.estimation"), 0.3);
  EXPECT_LT(value(found, "hand_height_ratio.estimation"), 0.8);
  EXPECT_EQ(value(found, "marked_ratio.estimation"), 0.0);
}

TEST_F(ResultsMovementTest, SaysWhoHasNoRecording) {
  write_file(temporary_.path() / "tiny.json", kTinyStudy);
  simulate({"tiny.json", "--participants", "2", "--study", "t.study", "--fast"});
  const nlohmann::json found = section(results({"t.study", "--movement"}), "recorded_movement");
  EXPECT_EQ(found["estimates"].size(), 0U);
  ASSERT_EQ(found["excluded"].size(), 2U);
  EXPECT_EQ(found["excluded"][0]["reason"], "no samples were kept, only summaries of strokes");
}

TEST_F(ResultsMovementTest, FitsOnWhatWasDeliveredTakeTheLimiterOutOfTheWeberFraction) {
  // The limit is 5 N. Group E feels 16 Pa s, which takes far more.
  nlohmann::json laboratory = nlohmann::json::parse(
      read_file(test_support::source_folder() / "data" / "laboratories" / "thesis.json"));
  laboratory["device"]["max_total_force_n"] = 5.0;
  write_file(temporary_.path() / "limited.json", laboratory.dump());
  simulate({"viscosity_discrimination", "--participants", "4", "--study", "v.study", "--fast",
            "--laboratory", "limited.json"});
  const nlohmann::json commanded = results({"v.study"});
  const nlohmann::json delivered = results({"v.study", "--delivered"});
  EXPECT_FALSE(commanded.contains("intensities"));
  EXPECT_EQ(delivered["intensities"]["basis"], "delivered");
  EXPECT_EQ(delivered["intensities"]["num_trials"], 4 * 80);
  EXPECT_EQ(delivered["intensities"]["num_left_out"], 0);
  EXPECT_LT(value(delivered, "group_e.weber_fraction"),
            0.8 * value(commanded, "group_e.weber_fraction"));
}

}  // namespace results_movement_test
}  // namespace jnd::app
