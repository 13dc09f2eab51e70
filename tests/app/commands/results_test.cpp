#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/tiny_study.h"
#include "support/places.h"
#include "support/program.h"
#include "support/sanitizer.h"

namespace jnd::app {
namespace results_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class ResultsCommandTest : public CommandTest {
 protected:
  void simulate(const std::string& file, const std::string& study, int participants,
                const std::string& laboratory = "thesis") {
    const ProgramOutcome outcome =
        jnd({"simulate", file, "--participants", std::to_string(participants), "--study", study,
             "--fast", "--laboratory", laboratory});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  }
  static std::set<std::string> names_in(const nlohmann::json& results) {
    std::set<std::string> names;
    for (const auto& section : results["sections"]) {
      for (const auto& estimate : section["estimates"]) names.insert(estimate["name"]);
    }
    return names;
  }
  /// Expects that every number is finite or null.
  static void expect_finite(const nlohmann::json& value) {
    if (value.is_number_float()) {
      EXPECT_TRUE(std::isfinite(value.get<double>()));
    }
    if (value.is_structured()) {
      for (const auto& part : value) expect_finite(part);
    }
  }
};

TEST_F(ResultsCommandTest, PrintsTheKeysOfTheContractForTheMagnitudeStudy) {
  simulate("magnitude_of_virtual_water", "m.study", 2);
  const ProgramOutcome outcome = jnd({"results", "m.study", "--resamples", "100", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const auto json = document(outcome.out);
  expect_finite(json);
  EXPECT_EQ(json["study"], "magnitude_of_virtual_water");
  EXPECT_EQ(json["simulated"], true);
  for (const auto& section : json["sections"]) {
    for (const char* key : {"name", "estimates", "excluded"}) {
      EXPECT_TRUE(section.contains(key)) << section["name"] << key;
    }
    for (const auto& estimate : section["estimates"]) {
      for (const char* key :
           {"name", "value", "ci95", "unit", "published", "calibrated", "n"}) {
        EXPECT_TRUE(estimate.contains(key)) << estimate["name"] << key;
      }
      EXPECT_EQ(estimate["ci95"].size(), 2U) << estimate["name"];
    }
  }
  const std::set<std::string> names = names_in(json);
  for (const char* name :
       {"magnitude_estimation.k", "magnitude_estimation.a", "magnitude_production.k",
        "magnitude_production.a", "combined.k", "combined.a", "stroke_width_m"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  for (const auto& section : json["sections"]) {
    for (const auto& estimate : section["estimates"]) {
      if (estimate["name"] != "magnitude_estimation.k") continue;
      EXPECT_EQ(estimate["published"], 0.6663);
      EXPECT_EQ(estimate["calibrated"], true);
      EXPECT_EQ(estimate["n"], 2);
    }
  }
}

TEST_F(ResultsCommandTest, HasWhatTheThesisLeftOpenAdjustedAndTheQuestionnaires) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  simulate("magnitude_of_virtual_water", "m.study", 4);
  const auto json = document(jnd({"results", "m.study", "--resamples", "100", "--json"}).out);
  expect_finite(json);
  const std::set<std::string> names = names_in(json);
  for (const char* name :
       {"magnitude_estimation.geometric.a", "magnitude_estimation.equalised.k",
        "magnitude_estimation.mean_at_0.5", "magnitude_production.intensity_on_magnitude.a",
        "combined.geometric_mean.a", "combined.within_shared_range.a",
        "magnitude_production.starting_value_slope", "questionnaire.realism",
        "questionnaire.realism.sd", "questionnaire.gender.female", "questionnaire.age_years"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  std::size_t num_adjusted = 0;
  for (const auto& section : json["sections"]) {
    for (const auto& comparison : section["comparisons"]) {
      if (comparison["p_value_holm"].is_null()) continue;
      EXPECT_TRUE(comparison["family"].get<std::string>().starts_with("exploratory"));
      EXPECT_FALSE(comparison["name"].get<std::string>().ends_with("sensitivity"));
      EXPECT_GE(comparison["p_value_holm"], comparison["p_value"]);
      ++num_adjusted;
    }
    if (section["name"] != "questionnaires") continue;
    EXPECT_FALSE(section["free_answers"].empty());
    for (const auto& answer : section["free_answers"]) {
      EXPECT_NE(answer["answer"].get<std::string>().find("simulated"), std::string::npos);
    }
  }
  EXPECT_GT(num_adjusted, 8U);
  EXPECT_NE(jnd({"results", "m.study", "--resamples", "100"}).out.find("Holm"),
            std::string::npos);
}

TEST_F(ResultsCommandTest, PrintsTheNamesOfTheContractForTheDiscriminationStudy) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  simulate("viscosity_discrimination", "v.study", 2);
  const auto json = document(jnd({"results", "v.study", "--resamples", "100", "--json"}).out);
  expect_finite(json);
  const std::set<std::string> names = names_in(json);
  for (const char* name : {"group_d.weber_fraction", "group_e.weber_fraction", "stroke_width_m",
                           "max_speed_m_per_s.group_d", "max_speed_m_per_s.group_e"}) {
    EXPECT_TRUE(names.contains(name)) << name;
  }
  bool compared = false;
  for (const auto& section : json["sections"]) {
    for (const auto& comparison : section["comparisons"]) {
      compared = compared || comparison["name"].get<std::string>().find(
                                 "ln ln(1 + w), paired") != std::string::npos;
    }
  }
  EXPECT_TRUE(compared);
}

TEST_F(ResultsCommandTest, ComparesTheBlocksThatAreAskedFor) {
  simulate("viscosity_pairs", "p.study", 3);
  const auto against = [this](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"results", "p.study", "--resamples", "100", "--json"};
    words.insert(words.end(), more.begin(), more.end());
    std::vector<std::string> names;
    const auto json = document(jnd(words).out);
    for (const auto& section : json["sections"]) {
      const std::string name = section["name"];
      if (name.find("_against_") != std::string::npos) names.push_back(name);
    }
    return names;
  };
  EXPECT_EQ(against({}).size(), 3U) << "every two of three references";
  EXPECT_EQ(against({"--compare", "pairs_thick,pairs_thin"}),
            std::vector<std::string>{"pairs_thick_against_pairs_thin"});
  const auto table =
      jnd({"results", "p.study", "--resamples", "100", "--compare", "pairs_thick,pairs_thin"});
  EXPECT_NE(table.out.find("[asked for with --compare, not planned in the study]"),
            std::string::npos)
      << table.out;
  for (const char* wrong : {"pairs_thick", "pairs_thick,none", "pairs_thin,pairs_thin"}) {
    const ProgramOutcome outcome = jnd({"results", "p.study", "--compare", wrong});
    EXPECT_EQ(outcome.exit_code, 2) << wrong;
    EXPECT_NE(outcome.err.find("--compare: expected two"), std::string::npos) << outcome.err;
  }
}

TEST_F(ResultsCommandTest, TheTableSaysThatItIsSimulatedAndShowsNoNan) {
  simulate("viscosity_discrimination", "v.study", 3);
  const ProgramOutcome outcome = jnd({"results", "v.study", "--resamples", "100"});
  ASSERT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("SIMULATED"), std::string::npos);
  EXPECT_NE(outcome.out.find("group_d.weber_fraction"), std::string::npos);
  // The main question of each block comes before everything else.
  const std::string in_short = outcome.out.substr(0, outcome.out.find("\n\ngroup_d\n"));
  for (const char* primary : {"group_d.weber_fraction_median_person",
                              "group_e.weber_fraction_median_person", "pse free (primary)"}) {
    EXPECT_NE(in_short.find(primary), std::string::npos) << primary;
  }
  EXPECT_NE(in_short.find("[exploratory, every two blocks]"), std::string::npos) << in_short;
  EXPECT_NE(in_short.find("Nobody planned a comparison"), std::string::npos) << in_short;
  EXPECT_EQ(in_short.find("individual"), std::string::npos) << in_short;
  EXPECT_EQ(outcome.out.find("nan"), std::string::npos) << outcome.out;
  EXPECT_EQ(outcome.out.find("inf "), std::string::npos) << outcome.out;
}

TEST_F(ResultsCommandTest, AForceLimiterAtFiveNewtonsMovesTheWeberFractionOfGroupE) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  // The limit is 5 N. Group E feels 16 Pa s, far above the limit, and group D feels 8 Pa s,
  // mostly below it.
  nlohmann::json laboratory = nlohmann::json::parse(
      read_file(test_support::source_folder() / "data" / "laboratories" / "thesis.json"));
  laboratory["device"]["max_total_force_n"] = 5.0;
  write_file(temporary_.path() / "limited.json", laboratory.dump());
  simulate("viscosity_discrimination", "free.study", 4);
  simulate("viscosity_discrimination", "limited.study", 4, "limited.json");
  const auto weber = [&](const char* study, const char* group) {
    const auto json = document(jnd({"results", study, "--resamples", "100", "--json"}).out);
    for (const auto& section : json["sections"]) {
      for (const auto& estimate : section["estimates"]) {
        if (estimate["name"] == std::string(group) + ".weber_fraction" &&
            estimate["value"].is_number()) {
          return estimate["value"].get<double>();
        }
      }
    }
    // If no slope is left at all, the Weber fraction is larger than any number.
    return std::numeric_limits<double>::infinity();
  };
  EXPECT_GT(weber("limited.study", "group_e"), 1.5 * weber("free.study", "group_e"));
  EXPECT_LT(weber("free.study", "group_e"), weber("free.study", "group_d"));
}

TEST_F(ResultsCommandTest, NoNumberIsEverNotFiniteHoweverFewAnswersThereAre) {
  write_file(temporary_.path() / "tiny.json", kTinyStudy);
  simulate("tiny.json", "t.study", 1);
  const ProgramOutcome outcome = jnd({"results", "t.study", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  expect_finite(document(outcome.out));
  const ProgramOutcome table = jnd({"results", "t.study"});
  EXPECT_EQ(table.exit_code, 0);
  EXPECT_EQ(table.out.find("nan"), std::string::npos) << table.out;
}

TEST_F(ResultsCommandTest, AnotherLaboratoryMovesTheNumbers) {
  if (test_support::kIsSanitized) GTEST_SKIP() << "minutes of the same code";
  write_file(temporary_.path() / "tiny.json", kTinyStudy);
  simulate("tiny.json", "a.study", 2);
  simulate("tiny.json", "b.study", 2, "misspecified");
  EXPECT_NE(jnd({"results", "a.study", "--json"}).out,
            jnd({"results", "b.study", "--json"}).out);
}

TEST_F(ResultsCommandTest, AChangedLaboratoryIsNotPassedOffAsTheShippedOne) {
  write_file(temporary_.path() / "tiny.json", kTinyStudy);
  const std::string shipped =
      read_file(test_support::source_folder().string() + "/data/laboratories/thesis.json");
  write_file(temporary_.path() / "mine.json",
             replaced(shipped, "\"dry_friction_n\": {\"value\": 0.4",
                      "\"dry_friction_n\": {\"value\": 0.5"));
  simulate("tiny.json", "a.study", 2);
  simulate("tiny.json", "b.study", 2, "mine.json");
  EXPECT_EQ(jnd({"results", "a.study"}).out.find("CHANGED"), std::string::npos);
  EXPECT_NE(jnd({"results", "b.study"}).out.find("\"thesis\", CHANGED from the shipped one"),
            std::string::npos);
}

}  // namespace results_test
}  // namespace jnd::app
