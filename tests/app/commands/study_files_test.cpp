#include <gtest/gtest.h>

#include <cmath>

#include <algorithm>

#include "app/commands/command_fixture.h"
#include "app/json_document.h"
#include "app/sentence.h"
#include "app/tiny_study.h"
#include "core/storage/study_store.h"
#include "support/program.h"

namespace jnd::app {
namespace study_files_test {

namespace fs = std::filesystem;
using test_support::ProgramOutcome;

class StudyFileCommandsTest : public CommandTest {};

TEST_F(StudyFileCommandsTest, ValidateTellsEveryProblemWithItsPlace) {
  std::string text = replaced(kTinyStudy, "\"repetitions\": 2", "\"repititions\": 2");
  text = replaced(text, "\"name\": \"tiny\"", "\"name\": 7");
  write_file(path("wrong.json"), text);
  const ProgramOutcome outcome = jnd({"validate", "wrong.json", "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto json = document(outcome.out);
  EXPECT_EQ(keys(json), (std::set<std::string>{"problems", "warnings"}));
  ASSERT_GE(json["problems"].size(), 2U);
  std::set<std::string> pointers;
  for (const auto& problem : json["problems"]) {
    EXPECT_EQ(keys(problem),
              (std::set<std::string>{"file", "line", "column", "pointer", "message"}));
    EXPECT_EQ(problem["file"], "wrong.json");
    EXPECT_GT(problem["line"], 0);
    EXPECT_GT(problem["column"], 0);
    pointers.insert(problem["pointer"]);
  }
  EXPECT_TRUE(pointers.contains("/name"));
  EXPECT_TRUE(pointers.contains("/stages/3/repititions"));
  const ProgramOutcome plain = jnd({"validate", "wrong.json"});
  EXPECT_EQ(plain.exit_code, 1);
  EXPECT_TRUE(plain.out.starts_with("wrong.json:3:")) << plain.out;
  EXPECT_NE(plain.out.find(": /name: expected"), std::string::npos) << plain.out;
}

TEST_F(StudyFileCommandsTest, ValidateFindsNothingInWhatIsShipped) {
  const ProgramOutcome outcome =
      jnd({"validate", "short_tour", "protocols/magnitude_of_virtual_water.json",
           "viscosity_discrimination", "--json"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  EXPECT_TRUE(document(outcome.out)["problems"].empty());
}

TEST_F(StudyFileCommandsTest, ValidateAsksAboutADecimalCommaAndTakesTheStudy) {
  write_file(path("comma.json"), replaced(kTinyStudy, "[4, 16]", "[4,5, 16]"));
  const ProgramOutcome plain = jnd({"validate", "comma.json"});
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  EXPECT_NE(plain.out.find("viscosity_pa_s: warning: expected levels in order"),
            std::string::npos)
      << plain.out;
  const auto json = document(jnd({"validate", "comma.json", "--json"}).out);
  EXPECT_TRUE(json["problems"].empty());
  ASSERT_EQ(json["warnings"].size(), 1U);
  EXPECT_EQ(keys(json["warnings"][0]),
            (std::set<std::string>{"file", "line", "column", "pointer", "message"}));
}

TEST_F(StudyFileCommandsTest, ValidateDoubtsAForceThatHardlyAnybodyMeansWithoutADevice) {
  write_file(path("thick.json"), replaced(kTinyStudy, "[4, 16]", "[4, 1000]"));
  const ProgramOutcome plain = jnd({"validate", "thick.json"});
  EXPECT_EQ(plain.exit_code, 0) << plain.err;
  // 1000 Pa s on the shape of a hand, 1.776 m, at 0.5 m/s give 888 N.
  EXPECT_NE(plain.out.find("warning: this takes 888 N on the whole hand at 0.5 m/s"),
            std::string::npos)
      << plain.out;
  const ProgramOutcome slow = jnd({"validate", "thick.json", "--speed-m-per-s", "0.03"});
  EXPECT_EQ(slow.out.find("warning"), std::string::npos) << slow.out;
}

TEST_F(StudyFileCommandsTest, ValidateTellsTheProblemsOfAllFiles) {
  write_file(path("a.json"), "[]");
  write_file(path("b.json"), "{");
  const auto json = document(jnd({"validate", "a.json", "b.json", "--json"}).out);
  std::set<std::string> files;
  for (const auto& problem : json["problems"]) files.insert(problem["file"]);
  EXPECT_EQ(files, (std::set<std::string>{"a.json", "b.json"}));
}

TEST_F(StudyFileCommandsTest, ValidateHoldsStimuliAgainstADeviceAtTheirPlaces) {
  write_file(path("strong.json"), replaced(kTinyStudy, "[4, 16]", "[4, 900]"));
  EXPECT_EQ(jnd({"validate", "strong.json"}).exit_code, 0) << "no device, no limits";
  const ProgramOutcome outcome =
      jnd({"validate", "strong.json", "--device", "lumped", "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto json = document(outcome.out);
  ASSERT_EQ(json["problems"].size(), 1U);
  const std::string pointer = json["problems"][0]["pointer"];
  EXPECT_TRUE(pointer.ends_with("/viscosity_pa_s/1")) << pointer;
  EXPECT_GT(json["problems"][0]["line"], 1);
  const std::string message = json["problems"][0]["message"];
  EXPECT_TRUE(message.starts_with("expected a stimulus that `lumped` can render at 0.5 m/s"))
      << message;
  EXPECT_NE(message.find("; it fits up to 0.0"), std::string::npos) << message;
  EXPECT_EQ(jnd({"validate", "strong.json", "--device", "lumped", "--speed-m-per-s", "0.01"})
                .exit_code,
            0);
  EXPECT_EQ(jnd({"validate", "short_tour", "magnitude_of_virtual_water", "finger_motion",
                 "viscosity_discrimination", "--device", "exoskeleton"})
                .exit_code,
            0);
}

TEST_F(StudyFileCommandsTest, ARunSaysThatTheDeviceCutsAStimulusAndGoesOn) {
  write_file(path("strong.json"), replaced(kTinyStudy, "[4, 16]", "[4, 800, 900]"));
  const ProgramOutcome outcome =
      jnd({"run", "strong.json", "--study", "s.study", "--participant", "P01", "--headless"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("jnd: caution: strong.json:"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("expected a stimulus that `lumped` can render"), std::string::npos)
      << outcome.err;
  EXPECT_NE(outcome.err.find("1 more of these; `jnd validate --device lumped` tells all"),
            std::string::npos)
      << outcome.err;
}

TEST_F(StudyFileCommandsTest, ValidateTellsWhatADeviceCannotRenderStably) {
  write_file(path("stiff.json"), replaced(kTinyStudy, "\"stages\": [",
                                          R"("stages": [{"kind": "explore", "name": "wall",
  "instruction": {"en": "Touch it."},
  "media": [{"medium": "solid", "stiffness_n_per_m": 100000, "duration_s": 5}]},)"));
  const ProgramOutcome outcome =
      jnd({"validate", "stiff.json", "--device", "exoskeleton", "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  bool found = false;
  const auto json = document(outcome.out);
  for (const auto& problem : json["problems"]) {
    EXPECT_EQ(problem["pointer"], "/stages/0/media/0/stiffness_n_per_m");
    found = found || problem["message"].get<std::string>().find("renders stably at") !=
                         std::string::npos;
  }
  EXPECT_TRUE(found) << outcome.out;
}

TEST_F(StudyFileCommandsTest, PlanCountsOrdersAndSaysHowLongSessionsTake) {
  write_file(
      path("square.json"),
      replaced(kTinyStudy, "\"scale\": [0.5, 2], \"repetitions\": 2",
               "\"scale\": [0.5, 2], \"repetitions\": 2, \"order\": {\"method\": \"latin\"}"));
  const ProgramOutcome outcome = jnd({"plan", "square.json", "--participants", "8", "--json"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  const auto& estimation = json["order_statistics"][0];
  EXPECT_EQ(estimation["block"], "estimation");
  EXPECT_EQ(estimation["stimuli"], (std::vector<double>{0.5, 2.0}));
  EXPECT_EQ(estimation["at_place"], (std::vector<std::vector<int>>{{8, 8}, {8, 8}}))
      << "eight people, two repetitions, half of them each way round";
  EXPECT_EQ(json["balance"].size(), 2U);
  EXPECT_EQ(json["balance"][0]["num_planned"], 4);
  EXPECT_EQ(json["durations"]["simulated"], true);
  EXPECT_GT(json["durations"]["duration_s"]["mean"], json["duration_s"])
      << "nobody compares two fluids in the 5 s that the study says";
  const std::string text = jnd({"plan", "square.json", "--participants", "8"}).out;
  EXPECT_NE(text.find("each stimulus 8 times at each place"), std::string::npos) << text;
  EXPECT_NE(text.find("`expected_trial_s` is 5 s, but simulated participants feel the stimuli"),
            std::string::npos)
      << text;
}

TEST_F(StudyFileCommandsTest, SchemaIsAlsoAReferenceToRead) {
  const ProgramOutcome outcome = jnd({"schema", "--markdown"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_TRUE(outcome.out.starts_with("# Studies\n"));
  EXPECT_EQ(jnd({"schema", "--markdown", "--json"}).exit_code, 2);
}

TEST_F(StudyFileCommandsTest, ANewStudyHasTheSchemaBesideItForEditors) {
  const ProgramOutcome outcome = jnd({"new", "honey"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("study.schema.json: written"), std::string::npos) << outcome.out;
  EXPECT_EQ(document(read_file(path("honey.json")))["$schema"], "./study.schema.json");
  EXPECT_EQ(read_file(path("study.schema.json")), jnd({"schema"}).out);
  const ProgramOutcome second = jnd({"new", "oil"});
  EXPECT_EQ(second.exit_code, 0);
  EXPECT_EQ(second.out.find("study.schema.json: "), std::string::npos) << second.out;
}

TEST_F(StudyFileCommandsTest, ASchemaOfAnotherVersionIsLeftAsItIs) {
  write_file(path("study.schema.json"), "{}");
  const ProgramOutcome outcome = jnd({"new", "honey"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.out.find("left as it is"), std::string::npos) << outcome.out;
  EXPECT_EQ(read_file(path("study.schema.json")), "{}");
}

TEST_F(StudyFileCommandsTest, SchemaIsOneDraft7Document) {
  const ProgramOutcome outcome = jnd({"schema"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto json = document(outcome.out);
  EXPECT_NE(json["$schema"].get<std::string>().find("draft-07"), std::string::npos);
  EXPECT_EQ(json["additionalProperties"], false);
  EXPECT_EQ(jnd({"schema", "--json"}).out, outcome.out);
}

TEST_F(StudyFileCommandsTest, ANewStudyValidatesPlansAndRuns) {
  const ProgramOutcome outcome = jnd({"new", "honey", "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(document(outcome.out)["file"], "honey.json");
  EXPECT_EQ(jnd({"validate", "honey.json"}).exit_code, 0);
  EXPECT_EQ(jnd({"plan", "honey.json"}).exit_code, 0);
  EXPECT_EQ(
      jnd({"simulate", "honey.json", "--participants", "2", "--study", "honey.study", "--fast"})
          .exit_code,
      0);
  EXPECT_EQ(jnd({"results", "honey.study"}).exit_code, 0);
}

TEST_F(StudyFileCommandsTest, NewCopiesAShippedStudyUnderItsOwnName) {
  EXPECT_EQ(jnd({"new", "mine", "--from", "short_tour"}).exit_code, 0);
  EXPECT_EQ(jnd({"validate", "mine.json"}).exit_code, 0);
  EXPECT_NE(read_file(path("mine.json")).find("\"name\": \"mine\""), std::string::npos);
}

TEST_F(StudyFileCommandsTest, NewWritesOverNothing) {
  write_file(path("mine.json"), "precious");
  const ProgramOutcome outcome = jnd({"new", "mine"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("nothing was overwritten"), std::string::npos);
  EXPECT_EQ(read_file(path("mine.json")), "precious");
}

TEST_F(StudyFileCommandsTest, PlanPrintsTheKeysOfTheContract) {
  write_file(path("tiny.json"), kTinyStudy);
  const ProgramOutcome outcome =
      jnd({"plan", "tiny.json", "--participants", "3", "--seed", "5", "--json"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  ASSERT_EQ(json["participants"].size(), 3U);
  for (const auto& participant : json["participants"]) {
    for (const char* key : {"id", "cells", "order"}) EXPECT_TRUE(participant.contains(key));
    int num_trials = 0;
    for (const auto& block : participant["order"]) {
      num_trials += static_cast<int>(block["trials"].size());
    }
    EXPECT_EQ(num_trials, kTinyTrials);
  }
  EXPECT_GT(json["duration_s"], 60.0);
  EXPECT_FALSE(json["range"].empty());
  for (const auto& entry : json["range"]) EXPECT_TRUE(entry["fits"].is_boolean());
}

TEST_F(StudyFileCommandsTest, PlanTellsStandardsFromStartingValues) {
  const std::string text =
      jnd({"plan", "viscosity_matching", "--participants", "1", "--seed", "5"}).out;
  EXPECT_NE(text.find("standards, and where each match starts"), std::string::npos) << text;
  EXPECT_NE(text.find("16 (from "), std::string::npos) << text;
}

TEST_F(StudyFileCommandsTest, PlanTellsThePracticeByItsLevelsAndNumbersWithoutTheirLastBits) {
  const std::vector<std::string> plan = {"plan", "viscosity_staircase", "--participants", "3"};
  EXPECT_NE(jnd(plan).out.find("practice: practice, at most 20 trials\n      levels "),
            std::string::npos)
      << jnd(plan).out;
  std::vector<std::string> as_json = plan;
  as_json.push_back("--json");
  const std::string text = jnd(as_json).out;
  EXPECT_EQ(text.find("0000000"), std::string::npos);
  EXPECT_EQ(text.find("9999999"), std::string::npos);
  EXPECT_EQ(text.find("e-1"), std::string::npos);
}

TEST_F(StudyFileCommandsTest, PlanTellsHowLongAllTrialsOfAStaircaseTake) {
  const auto json = document(
      jnd({"plan", "viscosity_threshold", "--participants", "2", "--seed", "5", "--json"}).out);
  // 2 staircases of at most 30 trials make 75 of 11 s, because a fifth of all are catch trials.
  const auto& order = json["participants"][0]["order"];
  const auto stairs = std::find_if(order.begin(), order.end(), [](const auto& block) {
    return block["block"] == "threshold_staircase";
  });
  ASSERT_NE(stairs, order.end());
  EXPECT_LT((*stairs)["num_trials"], 65);
  EXPECT_GE(json["longest_duration_s"].template get<double>(),
            json["duration_s"].template get<double>() +
                11.0 * (75 - (*stairs)["num_trials"].template get<int>()));
}

TEST_F(StudyFileCommandsTest, PlanExpectsFewerTrialsOfAPracticeThanItMayTake) {
  const auto json = document(
      jnd({"plan", "viscosity_staircase", "--participants", "2", "--seed", "5", "--json"}).out);
  const auto& practice = json["participants"][0]["order"][0];
  EXPECT_EQ(practice["block"], "practice");
  EXPECT_EQ(practice["num_trials"], 20);
  EXPECT_EQ(practice["num_trials_is_expected"], true) << "the answers end it";
  EXPECT_GE(practice["num_trials_simulated"], 5.0);
  EXPECT_LT(practice["num_trials_simulated"], 20.0);
  const auto& staircase = json["participants"][0]["order"][1];
  EXPECT_EQ(staircase["num_trials_simulated"], 50.0);
  const auto fixed =
      document(jnd({"plan", "viscosity_matching", "--participants", "1", "--json"}).out);
  EXPECT_EQ(fixed["participants"][0]["order"][0]["num_trials_is_expected"], false);
  EXPECT_FALSE(fixed["participants"][0]["order"][0].contains("num_trials_simulated"));
}

TEST_F(StudyFileCommandsTest, SessionsDrawTheOrdersThatWerePlanned) {
  write_file(path("tiny.json"), kTinyStudy);
  const auto plan =
      document(jnd({"plan", "tiny.json", "--participants", "2", "--seed", "5", "--json"}).out);
  ASSERT_EQ(jnd({"simulate", "tiny.json", "--participants", "2", "--seed", "5", "--study",
                 "tiny.study", "--fast"})
                .exit_code,
            0);
  const core::StudyStore store(path("tiny.study"), core::StudyStore::Mode::kReadOnly);
  for (std::int64_t session = 1; session <= 2; ++session) {
    std::vector<double> planned;
    for (const auto& block : plan["participants"][session - 1]["order"]) {
      for (const auto& trial : block["trials"]) {
        planned.push_back(trial.value("intensity", trial.value("starting_intensity", -1.0)));
      }
    }
    std::vector<double> drawn;
    for (const core::DesignRow& row : store.design(session)) {
      drawn.push_back(row.intensity.value_or(row.starting_intensity.value_or(-1.0)));
    }
    EXPECT_EQ(drawn, planned);
  }
}

TEST_F(StudyFileCommandsTest, PlanFillsTheCellsThatAStudyFolderLacks) {
  ASSERT_EQ(jnd({"simulate", "viscosity_discrimination", "--participants", "1", "--study",
                 "v.study", "--fast"})
                .exit_code,
            0);
  const auto json = document(jnd({"plan", "viscosity_discrimination", "--study", "v.study",
                                  "--participants", "1", "--json"})
                                 .out);
  EXPECT_EQ(json["participants"][0]["id"], "P02");
  int completed = 0;
  for (const auto& cell : json["balance"]) completed += cell["num_completed"].get<int>();
  EXPECT_EQ(completed, 1);
  for (const auto& cell : json["balance"]) EXPECT_LE(cell["num_planned"], 1) << cell;
}

TEST_F(StudyFileCommandsTest, AStudyFileOtherThanThatOfTheFolderIsAProblemOfThePlan) {
  write_file(path("mine.json"), kTinyStudy);
  ASSERT_EQ(
      jnd({"simulate", "mine.json", "--participants", "1", "--study", "m.study", "--fast"})
          .exit_code,
      0);
  EXPECT_EQ(jnd({"plan", "mine.json", "--study", "m.study"}).exit_code, 0);
  write_file(path("mine.json"), replaced(kTinyStudy, "[4, 16]", "[4, 15]"));
  const ProgramOutcome changed = jnd({"plan", "mine.json", "--study", "m.study"});
  EXPECT_EQ(changed.exit_code, 1) << "no session of it could be added";
  EXPECT_NE(changed.err.find("m.study: expected the study file that it was begun with"),
            std::string::npos)
      << changed.err;
}

TEST_F(StudyFileCommandsTest, StimuliThatTheDeviceCannotRenderAreAProblemOfThePlan) {
  write_file(path("strong.json"), replaced(kTinyStudy, "[4, 16]", "[4, 900]"));
  const ProgramOutcome plain = jnd({"plan", "strong.json"});
  EXPECT_EQ(plain.exit_code, 1);
  EXPECT_NE(plain.out.find("TOO STRONG"), std::string::npos)
      << "the plan is printed all the same";
  EXPECT_EQ(sentence_flaw(plain.err, {"strong.json: expected", "`lumped`", "found 1 of",
                                      "too strong: viscosity_pa_s 900 in `comparison` (799.",
                                      " N in all, "}),
            "");
  const ProgramOutcome outcome = jnd({"plan", "strong.json", "--json"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto json = document(outcome.out);
  EXPECT_EQ(json["problems"].size(), 1U);
  int num_too_strong = 0;
  for (const auto& entry : json["range"]) {
    if (entry["fits"] == true) continue;
    ++num_too_strong;
    EXPECT_EQ(entry["stage"], "comparison");
    EXPECT_EQ(entry["viscosity_pa_s"], 900.0);
    EXPECT_LT(entry["fits_up_to_m_per_s"], json["limits"]["expected_speed_m_per_s"]);
  }
  EXPECT_EQ(num_too_strong, 1);
  EXPECT_EQ(json["participants"].size(), 13U);
  // The same stimulus is weak enough for a slower hand.
  EXPECT_EQ(jnd({"plan", "strong.json", "--speed-m-per-s", "0.01"}).exit_code, 0);
}

TEST_F(StudyFileCommandsTest, WhatIsShippedFitsTheDevice) {
  for (const char* name :
       {"short_tour", "magnitude_of_virtual_water", "viscosity_discrimination"}) {
    const ProgramOutcome outcome = jnd({"plan", name, "--json"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_TRUE(document(outcome.out)["problems"].empty());
  }
}

TEST_F(StudyFileCommandsTest, PlanNamesLevelsThatCouldNotTellLapsesAndThoseThatWould) {
  const std::vector<std::string> plan = {"plan", "viscosity_discrimination"};
  std::vector<std::string> as_json = plan;
  as_json.emplace_back("--json");
  const auto lapses = document(jnd(as_json).out)["lapses"];
  ASSERT_EQ(lapses.size(), 2U);
  const auto& hard = lapses[lapses[0]["block"] == "group_d" ? 0 : 1];
  const auto& easy = lapses[lapses[0]["block"] == "group_d" ? 1 : 0];
  EXPECT_TRUE(hard["untold"]) << hard;
  EXPECT_GT(hard["fraction_change"], 0.08);
  EXPECT_LT(hard["easiest_ratio"], 0.99);
  // The level is 2.5 times ln(1 + w) from the reference.
  const double w = hard["weber_fraction"];
  EXPECT_NEAR(hard["easy_high"].get<double>(), 1.853 * std::pow(1.0 + w, 2.5), 1e-4);
  EXPECT_FALSE(easy["untold"]) << easy;
  const std::string text = jnd(plan).out;
  EXPECT_NE(text.find("group_d: simulated participants"), std::string::npos) << text;
  EXPECT_EQ(text.find("group_e: simulated participants"), std::string::npos) << text;
}

TEST_F(StudyFileCommandsTest, TheOrdersOfADoubleBlindStudyAreRefusedUntilItIsUnblinded) {
  write_file(path("blind.json"), replaced(kTinyStudy, "\"name\": \"tiny\"",
                                          "\"name\": \"tiny\", \"blinding\": \"double\""));
  ASSERT_EQ(
      jnd({"simulate", "blind.json", "--participants", "1", "--study", "b.study"}).exit_code,
      0);
  for (std::vector<std::string> words : std::vector<std::vector<std::string>>{
           {"plan", "blind.json"}, {"plan", "blind.json", "--study", "b.study"}}) {
    const ProgramOutcome plain = jnd(words);
    EXPECT_EQ(plain.exit_code, 1);
    EXPECT_EQ(plain.out, "");
    EXPECT_EQ(sentence_flaw(plain.err, {"blind.json", "double"}), "");
    words.emplace_back("--json");
    const ProgramOutcome outcome = jnd(words);
    EXPECT_EQ(outcome.exit_code, 1);
    const auto json = document(outcome.out);
    EXPECT_EQ(keys(json), std::set<std::string>{"error"});
    EXPECT_NE(json["error"].get<std::string>().find("double"), std::string::npos);
  }
  ASSERT_EQ(jnd({"unblind", "b.study", "--reason", "all data are in"}).exit_code, 0);
  EXPECT_EQ(jnd({"plan", "blind.json", "--study", "b.study", "--json"}).exit_code, 0);
  EXPECT_EQ(jnd({"plan", "blind.json", "--json"}).exit_code, 1)
      << "says who, without the folder";
}

}  // namespace study_files_test
}  // namespace jnd::app
