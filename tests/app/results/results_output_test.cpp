#include "app/results/results_output.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace jnd::app {
namespace results_output_test {

analysis::StudyResults some_results() {
  analysis::StudyResults results{
      .study = "honey", .simulated = true, .laboratory = "lab", .num_participants = 2};
  analysis::ResultsSection section{.name = "group_d"};
  section.estimates.push_back({.name = "group_d.held",
                               .value = 0.5,
                               .ci95 = {.low = 0.4, .high = std::nullopt},
                               .unit = "m",
                               .published = 0.6,
                               .n = 2});
  section.estimates.push_back({.name = "group_d.fitted",
                               .value = 1.25,
                               .ci95 = {.low = 1.0, .high = 1.5},
                               .unit = "1",
                               .published = 1.3,
                               .published_sd = 0.1,
                               .calibrated = true,
                               .n = 2});
  section.estimates.push_back({.name = "group_d.unpublished", .value = 7.0, .unit = "1"});
  section.estimates.push_back(
      {.name = "group_d.broken", .value = std::numeric_limits<double>::quiet_NaN()});
  section.comparisons.push_back({.name = "a - b", .comparison = {}});
  section.comparisons.back().comparison.status = analysis::FitStatus::kDegenerate;
  section.comparisons.back().comparison.reason = "one pair only";
  section.excluded.push_back({"P03", "no answers in group_d"});
  results.sections.push_back(section);
  return results;
}

TEST(ResultsOutput, CautionsAndReasonsStandBesideTheirNumbersInTextAndJson) {
  analysis::StudyResults results = some_results();
  analysis::ResultsSection& section = results.sections[0];
  section.estimates[0].cautions = {"P09 is in it"};
  section.estimates[0].primary = true;
  section.estimates[2].value.reset();
  section.estimates[2].reason = "nobody has a value";
  section.comparisons[0].cautions = {"a test of P09"};
  section.participants.push_back({"P09", "group_d.held", 0.7, {}, ""});
  section.participants[0].cautions = {"falls"};
  section.cautions = {{"P09", "answers fall"}};
  const nlohmann::json json = results_json(results)["sections"][0];
  EXPECT_EQ(json["estimates"][0]["cautions"], nlohmann::json::array({"P09 is in it"}));
  EXPECT_EQ(json["estimates"][1]["cautions"], nlohmann::json::array());
  EXPECT_EQ(json["estimates"][2]["reason"], "nobody has a value");
  EXPECT_EQ(json["comparisons"][0]["cautions"][0], "a test of P09");
  EXPECT_EQ(json["participants"][0]["cautions"][0], "falls");
  EXPECT_EQ(json["cautions"],
            nlohmann::json::parse(R"([{"participant":"P09","caution":"answers fall"}])"));
  const std::string table = to_table(results);
  const std::string caution = "      caution: P09 is in it\n";
  const std::size_t in_short = table.find(caution);
  ASSERT_NE(in_short, std::string::npos) << table;
  EXPECT_NE(table.find(caution, in_short + 1), std::string::npos) << table;
  EXPECT_NE(table.find("; no value: nobody has a value"), std::string::npos) << table;
  EXPECT_NE(table.find("  caution: P09: answers fall\n"), std::string::npos) << table;
  EXPECT_NE(table.find("      caution: falls\n"), std::string::npos) << table;
  EXPECT_NE(to_comparison_table(results).find(caution), std::string::npos);
}

TEST(ResultsOutput, JsonHasTheKeysOfTheContractAndNullForWhatIsNot) {
  const nlohmann::json json = results_json(some_results());
  EXPECT_EQ(json["study"], "honey");
  EXPECT_EQ(json["simulated"], true);
  const nlohmann::json& section = json["sections"][0];
  EXPECT_EQ(section["name"], "group_d");
  EXPECT_EQ(
      section["excluded"],
      nlohmann::json::parse(R"([{"participant":"P03","reason":"no answers in group_d"}])"));
  const nlohmann::json& held = section["estimates"][0];
  EXPECT_EQ(held["value"], 0.5);
  EXPECT_EQ(held["ci95"], nlohmann::json::parse("[0.4, null]"));
  EXPECT_EQ(held["published"], 0.6);
  EXPECT_EQ(held["calibrated"], false);
  EXPECT_EQ(held["unit"], "m");
  EXPECT_EQ(held["n"], 2);
  EXPECT_TRUE(section["estimates"][3]["value"].is_null()) << "never NaN";
  EXPECT_TRUE(section["comparisons"][0]["p_value"].is_null());
}

TEST(ResultsOutput, TheTableHasEveryEstimateAndNoNan) {
  const std::string table = to_table(some_results());
  for (const char* words : {"SIMULATED", "\"lab\"", "group_d.held", "group_d.fitted",
                            "group_d.unpublished", "one pair only", "P03", "open"}) {
    EXPECT_NE(table.find(words), std::string::npos) << words << '\n' << table;
  }
  EXPECT_EQ(table.find("nan"), std::string::npos) << table;
}

TEST(ResultsOutput, SessionsThatAreMissingStandBelowTheHeading) {
  analysis::StudyResults results = some_results();
  EXPECT_EQ(to_table(results).find("session"), std::string::npos);
  results.sessions = {
      .open = {"P13"}, .ended_early = {"P02", "P05"}, .num_pilots = 1, .num_withdrawn = 2};
  const std::string table = to_table(results);
  EXPECT_NE(table.find("honey: 2 participants, SIMULATED (laboratory \"lab\")\n"
                       "1 session open: P13; 2 sessions ended early: P02, P05; 1 pilot session "
                       "left out; 2 sessions of participants who withdrew left no data\n"),
            std::string::npos)
      << table;
  const nlohmann::json json = results_json(results);
  EXPECT_EQ(json["sessions"], nlohmann::json::parse(
                                  R"({"open": ["P13"], "ended_early": ["P02", "P05"],
                                      "num_pilots_left_out": 1, "num_withdrawn": 2})"));
}

TEST(ResultsOutput, TheComparisonTellsWhatWasCalibratedFromWhatWasHeldOut) {
  const std::string table = to_comparison_table(some_results());
  EXPECT_NE(table.find("calibrated"), std::string::npos) << table;
  EXPECT_NE(table.find("held out"), std::string::npos) << table;
  EXPECT_LT(table.find("group_d.fitted"), table.find("group_d.held")) << table;
  EXPECT_EQ(table.find("group_d.unpublished"), std::string::npos) << table;
  EXPECT_NE(table.find("1.3 (sd 0.1)"), std::string::npos) << table;
}

/// Returns results in which simulated studies are compared with one of the estimates.
analysis::StudyResults compared_results() {
  analysis::StudyResults results = some_results();
  analysis::PredictiveTail tail{
      .values = {0.4, 0.5, 0.7}, .median = 0.5, .low = 0.4, .high = 0.7};
  tail.tail = 1.0 / 3.0;
  tail.standard_error = 0.1;
  tail.p_value = 2.0 / 3.0;
  results.sections[0].estimates[0].predictive = tail;
  results.sections[0].estimates[0].published_statistic = "mean of something";
  results.sections[0].estimates[1].predictive = tail;
  results.sections[0].estimates[1].predictive->tail = 0.0;
  results.sections[0].estimates[1].predictive->is_below = true;
  results.predictive = {.num_people = 52,
                        .num_studies = 1000,
                        .num_participants = 13,
                        .joint = analysis::JointTail{.num_statistics = 2, .p_value = 0.25}};
  return results;
}

TEST(ResultsOutput, TheComparisonTellsHowManySimulatedStudiesAreAsFarOut) {
  const std::string table = to_comparison_table(compared_results());
  for (const char* words :
       {"simulated studies", "tail", "0.5000 (0.4000 .. 0.7000)", "0.333 above",
        "< 0.001 below", "all, 2 together: as far out are 0.250 of the simulated studies"}) {
    EXPECT_NE(table.find(words), std::string::npos) << words << '\n' << table;
  }
  EXPECT_EQ(table.find("inside"), std::string::npos) << table;
  EXPECT_NE(to_table(compared_results()).find("published 0.6, tail 0.333 above (se 0.100)"),
            std::string::npos);
}

TEST(ResultsOutput, WithoutSimulatedStudiesTheComparisonSaysWhyAndKeepsTheIntervals) {
  analysis::StudyResults results = some_results();
  results.predictive.reason = "none are stored";
  results.sections[0].estimates[1].published_z = -1.32;
  const std::string table = to_comparison_table(results);
  for (const char* words : {"95 % interval", "1.0000 .. 1.5000", "-1.3",
                            "without simulated studies: none are stored"}) {
    EXPECT_NE(table.find(words), std::string::npos) << words << '\n' << table;
  }
  EXPECT_EQ(table.find("tail"), std::string::npos) << table;
}

TEST(ResultsOutput, JsonTellsTheStatisticAndTheTail) {
  const nlohmann::json json = results_json(compared_results());
  const nlohmann::json& held = json["sections"][0]["estimates"][0];
  EXPECT_EQ(held["published_statistic"], "mean of something");
  EXPECT_EQ(held["predictive_p"], 2.0 / 3.0);
  EXPECT_EQ(held["predictive"], nlohmann::json::parse(R"({"median": 0.5,
      "middle95": [0.4, 0.7], "tail": 0.3333333333333333, "side": "above",
      "tail_standard_error": 0.1, "num_studies": 3})"));
  EXPECT_TRUE(json["sections"][0]["estimates"][2]["predictive"].is_null());
  EXPECT_EQ(json["predictive"]["num_studies"], 1000);
  EXPECT_EQ(json["predictive"]["joint"]["num_statistics"], 2);
  EXPECT_TRUE(json["predictive"]["joint_held_out"].is_null());
}

/// Returns a section as the questionnaires and the exploratory tests make it.
analysis::StudyResults answered_results() {
  analysis::StudyResults results{.study = "honey", .num_participants = 2};
  analysis::ResultsSection section{.name = "questionnaires"};
  section.participants.push_back({"P01", "questionnaire.safety", 10.0, {}, ""});
  section.participants.push_back({"P02", "questionnaire.safety", 7.0, {}, ""});
  section.participants.push_back({"P01", "questionnaire.freedom", 3.0, {}, ""});
  section.participants.push_back({"P01", "own.k", 0.5, {.low = 0.25, .high = 1.0}, ""});
  section.comparisons.push_back({.name = "against 0, t",
                                 .comparison = analysis::one_sample_t_test({1.0, 2.0, 4.0}),
                                 .p_value_holm = 0.5,
                                 .family = "exploratory, t tests"});
  section.comparisons.push_back({.name = "against 0, ranks",
                                 .comparison = analysis::wilcoxon_test({1, 2, 4}, {0, 0, 0}),
                                 .ratio_of = "match"});
  section.free_answers.push_back({"P02", "remarks", "Anything else?", "wetness"});
  results.sections.push_back(section);
  return results;
}

TEST(ResultsOutput, JsonHasTheAdjustedTestsEffectSizesAndFreeAnswers) {
  const nlohmann::json section = results_json(answered_results())["sections"][0];
  const nlohmann::json& t = section["comparisons"][0];
  EXPECT_EQ(t["p_value_holm"], 0.5);
  EXPECT_EQ(t["family"], "exploratory, t tests");
  EXPECT_TRUE(t["hedges_g_ci95"][0].is_number());
  const nlohmann::json& ranks = section["comparisons"][1];
  EXPECT_TRUE(ranks["p_value_holm"].is_null());
  EXPECT_EQ(ranks["rank_biserial"], 1.0);
  EXPECT_EQ(ranks["statistic"], 0.0);
  EXPECT_EQ(ranks["statistic_name"], "T");
  EXPECT_EQ(ranks["statistics"], (nlohmann::json{{"V", 6.0}, {"T", 0.0}}));
  EXPECT_EQ(t["statistics"].size(), 1U);
  EXPECT_EQ(t["statistic_name"], "t");
  EXPECT_EQ(ranks["hodges_lehmann"], 2.25);
  EXPECT_TRUE(ranks.contains("hodges_lehmann_ci95"));
  EXPECT_TRUE(ranks["rank_biserial_ci95"].is_null());
  EXPECT_EQ(ranks["ratio_of"], "match");
  EXPECT_NEAR(ranks["ratio"].get<double>(), 9.487735836358526, 1e-12) << "exp(2.25)";
  EXPECT_TRUE(t["ratio"].is_null());
  EXPECT_EQ(section["free_answers"], nlohmann::json::parse(R"([{"participant": "P02",
      "item": "remarks", "question": "Anything else?", "answer": "wetness"}])"));
}

TEST(ResultsOutput, TheTablePutsPlainNumbersInColumnsAndSaysWhatWasSaid) {
  const std::string table = to_table(answered_results());
  EXPECT_NE(table.find("match 9.4877 times as large ("), std::string::npos) << table;
  EXPECT_NE(table.find("              safety   freedom\n"), std::string::npos) << table;
  EXPECT_NE(table.find("  P01            10.0000    3.0000\n"), std::string::npos) << table;
  EXPECT_NE(table.find("  P02             7.0000         -\n"), std::string::npos) << table;
  EXPECT_NE(table.find("P01 own.k"), std::string::npos) << table;
  EXPECT_NE(table.find("P02 remarks: wetness"), std::string::npos) << table;
  EXPECT_NE(table.find("Holm p = 0.5000"), std::string::npos) << table;
  EXPECT_NE(table.find("Hodges-Lehmann 2.2500"), std::string::npos) << table;
  EXPECT_NE(table.find("V = 6, T = 0, p = 0.2500"), std::string::npos) << table;
  EXPECT_NE(table.find("rank-biserial r 1.0000\n"), std::string::npos) << table;
}

TEST(ResultsOutput, CountsAreWholeNumbers) {
  analysis::ResultsSection section{.name = "match"};
  section.estimates = {{.name = "match.num_zeros", .value = 3.0, .unit = "1"},
                       {.name = "match.ratio", .value = 3.0, .unit = "1"}};
  section.participants = {{"P01", "practice.num_trials", 14.0, {}, ""},
                          {"P01", "practice.criterion_met", 1.0, {}, ""}};
  const std::string table = to_table({.study = "honey", .sections = {section}});
  EXPECT_EQ(table.find("14.0"), std::string::npos) << table;
  EXPECT_EQ(table.find("1.0000"), std::string::npos) << table;
  EXPECT_NE(table.find(" 14 "), std::string::npos) << table;
  EXPECT_EQ(table.find("3.0000"), table.rfind("3.0000")) << "of the ratio alone\n" << table;
  EXPECT_NE(table.find("3.0000"), std::string::npos);
}

TEST(ResultsOutput, WhatMayBeWrongSaysSoBelowTheNumberAndInJson) {
  analysis::ResultsSection section{.name = "group_d"};
  section.estimates = {{.name = "group_d.w",
                        .value = 0.1,
                        .unit = "1",
                        .published = 0.2,
                        .primary = true,
                        .n = 2,
                        .cautions = {"all of it"}},
                       {.name = "group_d.sound", .value = 0.2, .unit = "1", .n = 2}};
  section.participants = {{"P01", "group_d.pse", 12.0, {}, "", {"at the edge"}},
                          {"P02", "group_d.pse", 10.0, {}, ""}};
  const analysis::StudyResults results{.study = "honey", .sections = {section}};
  const std::string table = to_table(results);
  const std::size_t in_short = table.find("caution: all of it\n");
  EXPECT_LT(in_short, table.rfind("caution: all of it\n")) << "where it stands again\n"
                                                           << table;
  EXPECT_NE(table.find("P01 group_d.pse"), std::string::npos) << "not in a column\n" << table;
  EXPECT_NE(table.find("caution: at the edge\n"), std::string::npos) << table;
  EXPECT_NE(to_comparison_table(results).find("caution: all of it\n"), std::string::npos);
  const nlohmann::json json = results_json(results)["sections"][0];
  EXPECT_EQ(json["estimates"][0]["cautions"][0], "all of it");
  EXPECT_TRUE(json["estimates"][1]["cautions"].empty());
  EXPECT_EQ(json["participants"][0]["cautions"][0], "at the edge");
  EXPECT_TRUE(json["participants"][1]["cautions"].empty());
}

TEST(ResultsOutput, AnEndThatIsNoStatementIsPrintedAsOpenAndKeptInJson) {
  analysis::StudyResults results{.study = "honey", .num_participants = 1};
  analysis::ResultsSection section{.name = "group_d"};
  section.participants.push_back(
      {"P06", "group_d.weber_fraction", 1.6, {.low = 0.618, .high = 402367.0}, ""});
  results.sections.push_back(section);
  const std::string table = to_table(results);
  EXPECT_NE(table.find("0.6180 .. open"), std::string::npos) << table;
  EXPECT_NE(table.find("not bounded by these data"), std::string::npos) << table;
  EXPECT_EQ(results_json(results)["sections"][0]["participants"][0]["ci95"][1], 402367.0);
}

}  // namespace results_output_test
}  // namespace jnd::app
