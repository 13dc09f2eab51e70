#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "app/commands/fit_fixture.h"
#include "app/json_document.h"
#include "support/program.h"

namespace jnd::app {
namespace fit_test {

using test_support::ProgramOutcome;

class FitCommandTest : public FitFixture {};

constexpr char kAnswers[] =
    "intensity,num_yes,num_trials\n5,2,20\n8,10,20\n12,17,20\n20,20,20\n";

TEST_F(FitCommandTest, WeberPrintsTheKeysOfTheContract) {
  table("a.csv", kAnswers);
  const ProgramOutcome outcome = fit({"weber", "--csv", "a.csv", "--reference", "8"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_EQ(outcome.err, "");
  const auto json = document(outcome.out);
  for (const char* key : {"status", "reason", "method", "weber_fraction", "weber_fraction_ci95",
                          "standard_error", "log_likelihood", "deviance", "pse", "pse_ci95",
                          "lapse_rate", "r_squared", "bootstrap"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["method"], "ml");
  EXPECT_EQ(json["pse"], 8.0);
  EXPECT_EQ(json["lapse_rate"], 0.0);
  EXPECT_EQ(json["weber_fraction_ci95"].size(), 2U);
  EXPECT_LT(json["weber_fraction_ci95"][0], json["weber_fraction"]);
  EXPECT_GT(json["weber_fraction_ci95"][1], json["weber_fraction"]);
}

TEST_F(FitCommandTest, WeberTellsTheBootstrapAndIsReproducible) {
  table("a.csv", kAnswers);
  const std::vector<std::string> words = {
      "weber",  "--csv", "a.csv",       "--reference", "8",      "--free", "pse",
      "--free", "lapse", "--bootstrap", "50",          "--seed", "3"};
  const ProgramOutcome outcome = fit(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["bootstrap"]["n"], 50);
  EXPECT_TRUE(json["bootstrap"]["ci95"].is_array());
  EXPECT_TRUE(json["bootstrap"]["method"].is_string());
  EXPECT_TRUE(json["pse_ci95"].is_array());
  EXPECT_EQ(fit(words).out, outcome.out);
}

TEST_F(FitCommandTest, LeastSquaresTellsRSquared) {
  table("a.csv", kAnswers);
  const auto json =
      document(fit({"weber", "--csv", "a.csv", "--reference", "8", "--method", "lsq"}).out);
  EXPECT_EQ(json["method"], "lsq");
  EXPECT_GT(json["r_squared"], 0.9);
}

TEST_F(FitCommandTest, AWeberFractionThatDoesNotExistIsExit1WithItsJson) {
  table("a.csv", "intensity,num_yes,num_trials\n5,0,20\n20,20,20\n");
  const ProgramOutcome outcome = fit({"weber", "--csv", "a.csv", "--reference", "8"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto json = document(outcome.out);
  EXPECT_EQ(json["status"], "degenerate");
  EXPECT_TRUE(json["weber_fraction"].is_null());
  EXPECT_TRUE(json["reason"].is_string());
}

TEST_F(FitCommandTest, PowerPrintsTheKeysOfTheContract) {
  table("m.csv", "intensity,magnitude\n0,0\n1,2\n4,4\n9,6\n");
  const ProgramOutcome outcome = fit({"power", "--csv", "m.csv"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto json = document(outcome.out);
  for (const char* key :
       {"status", "k", "a", "k_standard_error", "a_standard_error", "r_squared", "excluded"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_NEAR(json["k"].get<double>(), 2.0, 1e-9);
  EXPECT_NEAR(json["a"].get<double>(), 0.5, 1e-9);
  EXPECT_EQ(json["excluded"].size(), 1U) << "at intensity 0 a law is 0 whatever k and a are";
  EXPECT_EQ(json["num_at_zero"], 1);
  EXPECT_EQ(json["num_rows"], 3);
  const auto log_log = document(fit({"power", "--csv", "m.csv", "--method", "loglog"}).out);
  EXPECT_EQ(log_log["excluded"].size(), 1U);
}

TEST_F(FitCommandTest, PowerLawsHaveAnOffsetOrAThresholdWhereThatIsAskedFor) {
  table("o.csv", "intensity,magnitude\n1,3\n4,5.1\n9,6.9\n16,9.1\n25,10.9\n");
  const auto offset = document(fit({"power", "--csv", "o.csv", "--shift", "offset"}).out);
  EXPECT_EQ(offset["status"], "ok");
  EXPECT_NEAR(offset["magnitude_offset"].get<double>(), 1.0, 0.5) << "1 + 2 sqrt I, about";
  EXPECT_NEAR(offset["a"].get<double>(), 0.5, 0.1);
  EXPECT_TRUE(offset["shift_ci95"].is_array());
  EXPECT_TRUE(offset["intensity_threshold"].is_null());
  const std::string told =
      fit({"power", "--csv", "o.csv", "--shift", "threshold", "--method", "loglog"}, false).out;
  EXPECT_NE(told.find("S = k (I - I0)^a by least squares of the logarithms"), std::string::npos)
      << told;
  EXPECT_NE(told.find("against the law without it: F = "), std::string::npos) << told;
  const ProgramOutcome wrong =
      fit({"power", "--csv", "o.csv", "--shift", "offset", "--method", "loglog"});
  EXPECT_EQ(wrong.exit_code, 2);
  EXPECT_NE(wrong.err.find("expected --method nls, found loglog"), std::string::npos);
}

TEST_F(FitCommandTest, PowerCountsTheRowsAtIntensityZeroThatItLeavesOut) {
  table("m.csv", "intensity,magnitude\n0,0\n0,0\n0,0\n1,1\n2,3\n4,3\n");
  const std::string out = fit({"power", "--csv", "m.csv"}, false).out;
  EXPECT_NE(out.find("left out 3 rows, lines 2, 3, 4: the intensity is 0"), std::string::npos)
      << out;
  EXPECT_NE(out.find("no interval: one degree of freedom is too few"), std::string::npos)
      << out;
}

TEST_F(FitCommandTest, TextAndJsonHaveOneIntervalOfTheFactor) {
  table("m.csv", "intensity,magnitude\n1e12,3e30\n2e12,6e30\n4e12,11e30\n8e12,25e30\n");
  const std::string out = fit({"power", "--csv", "m.csv"}, false).out;
  EXPECT_EQ(out.find("not bounded"), std::string::npos) << out;
  EXPECT_NE(out.find("95 % 1.185e+14 to 5.73e+20"), std::string::npos) << out;
  const auto json = document(fit({"power", "--csv", "m.csv"}).out);
  EXPECT_NEAR(json["k_ci95"][0].get<double>() / 1.18e14, 1.0, 0.01);
  EXPECT_NEAR(json["k_ci95"][1].get<double>() / 5.73e20, 1.0, 0.01);
}

TEST_F(FitCommandTest, GroupsAreFittedOnTheirOwn) {
  table("m.csv", "who,intensity,magnitude\nx,1,2\nx,4,4\ny,1,3\ny,2,6\n");
  const auto json = document(fit({"power", "--csv", "m.csv", "--group-by", "who"}).out);
  ASSERT_EQ(json["groups"].size(), 2U);
  EXPECT_EQ(json["groups"][0]["group"]["who"], "x");
  EXPECT_NEAR(json["groups"][1]["a"].get<double>(), 1.0, 1e-9);
  EXPECT_TRUE(json["groups"][0]["k_standard_error"].is_null()) << "two rows";
}

TEST_F(FitCommandTest, BetweenThePublishedCurvesIsThePublishedCurve) {
  // Schmidt (2018), eq. D.3 to D.5, gives 0.5145 I^0.9021.
  const ProgramOutcome outcome =
      fit({"between", "--k1", "0.6663", "--a1", "0.6386", "--k2", "0.3761", "--a2", "1.206",
           "--intensities", "0,0.5,1,1.5,2,2.5,3,3.5,4"});
  EXPECT_EQ(outcome.exit_code, 0);
  const auto json = document(outcome.out);
  EXPECT_NEAR(json["k"].get<double>(), 0.5145, 0.01);
  EXPECT_NEAR(json["a"].get<double>(), 0.9021, 0.01);
}

TEST_F(FitCommandTest, BetweenRefusesWhatIsNoNumber) {
  for (const char* wrong : {"nan", "inf", "-inf"}) {
    const ProgramOutcome outcome = fit({"between", "--k1", "1", "--a1", "1", "--k2", "1",
                                        "--a2", wrong, "--intensities", "1,2"});
    EXPECT_EQ(outcome.exit_code, 2) << wrong;
    EXPECT_EQ(outcome.out, "") << wrong;
  }
}

TEST_F(FitCommandTest, TextSaysOpenEndsAndMissingIntervalsInWords) {
  table("one.csv", "intensity,num_yes,num_trials\n12,7,10\n");
  const std::string one = fit({"weber", "--csv", "one.csv", "--reference", "8"}, false).out;
  EXPECT_NE(one.find("1 level, 10 trials"), std::string::npos) << one;
  EXPECT_NE(one.find("not bounded by these data"), std::string::npos) << one;
  const std::string lsq =
      fit({"weber", "--csv", "one.csv", "--reference", "8", "--method", "lsq"}, false).out;
  EXPECT_NE(lsq.find("no interval: no degree of freedom is left"), std::string::npos) << lsq;
  EXPECT_EQ(lsq.find("standard error"), std::string::npos) << lsq;
  table("line.csv", "intensity,magnitude\n1,2\n2,4\n3,6\n4,8\n");
  const std::string line = fit({"power", "--csv", "line.csv"}, false).out;
  EXPECT_NE(line.find("no interval: the power law passes through every row"), std::string::npos)
      << line;
  const auto json = document(fit({"power", "--csv", "line.csv"}).out);
  EXPECT_TRUE(json["k_ci95"].is_null() || json["k_ci95"][0].is_null()) << json["k_ci95"];
  EXPECT_EQ(json["no_interval"], "the power law passes through every row");
  table("three.csv", "intensity,magnitude\n1,-0.1\n2,2\n4,3\n");
  const std::string three = fit({"power", "--csv", "three.csv"}, false).out;
  EXPECT_NE(three.find("one degree of freedom is too few"), std::string::npos) << three;
  EXPECT_NE(three.find("below 0"), std::string::npos) << three;
}

TEST_F(FitCommandTest, AnEmptyGroupIsMarked) {
  table("m.csv", "who,intensity,magnitude\n,1,2\n,4,4\ny,1,3\ny,2,6\n");
  const std::string out = fit({"power", "--csv", "m.csv", "--group-by", "who"}, false).out;
  EXPECT_NE(out.find("who (empty)\n"), std::string::npos) << out;
}

constexpr char kForced[] =
    "intensity,num_yes,num_trials\n0.5,21,40\n0.8,20,40\n1.2,27,40\n1.8,34,40\n2.7,39,40\n";

TEST_F(FitCommandTest, CountsOfAForcedChoiceAreWarnedOfUntilTheirChanceIsTold) {
  table("f.csv", kForced);
  const std::vector<std::string> words = {"weber", "--csv",  "f.csv", "--reference",
                                          "1",     "--free", "pse"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), words.begin(), words.end());
    return document(fit(more).out);
  };
  const auto as_yes_no = with({});
  ASSERT_EQ(as_yes_no["warnings"].size(), 1U) << as_yes_no["warnings"];
  EXPECT_NE(as_yes_no["warnings"][0].get<std::string>().find("--guess"), std::string::npos);
  EXPECT_TRUE(with({"--guess", "0"})["warnings"].empty()) << "yes and no are told";
  const auto forced = with({"--guess", "1/2"});
  EXPECT_TRUE(forced["warnings"].empty()) << forced["warnings"];
  EXPECT_EQ(forced["guess_rate"], 0.5);
  EXPECT_EQ(forced["status"], "ok");
  EXPECT_GT(forced["pse"].get<double>(), 1.3 * as_yes_no["pse"].get<double>());
  EXPECT_NE(fit(words, false).out.find("--guess 1/2"), std::string::npos);
}

TEST_F(FitCommandTest, AnswersThatFallAreWarnedOf) {
  table("f.csv", "intensity,num_yes,num_trials\n2,19,20\n3,16,20\n4,13,20\n5,11,20\n");
  const std::vector<std::string> words = {"weber", "--csv", "f.csv", "--reference", "1"};
  const auto json = document(fit(words).out);
  EXPECT_EQ(json["status"], "ok");
  ASSERT_FALSE(json["warnings"].empty());
  const std::string first = json["warnings"][0];
  EXPECT_NE(first.find("the answers fall as the intensity grows"), std::string::npos) << first;
  EXPECT_NE(first.find("wrong way round"), std::string::npos) << first;
  for (const std::string warning : json["warnings"]) {
    EXPECT_EQ(warning.find("--guess"), std::string::npos) << "nor are they right answers";
    EXPECT_EQ(warning.find("--overdispersion"), std::string::npos) << "nor do they scatter";
  }
  EXPECT_NE(fit(words, false).out.find("note: the answers fall"), std::string::npos);
  // This also holds if there is no curve.
  table("f.csv", "intensity,num_yes,num_trials\n0.5,9,10\n2,1,10\n");
  const auto none = document(fit(words).out);
  EXPECT_EQ(none["status"], "degenerate");
  EXPECT_EQ(none["warnings"].size(), 1U);
  table("f.csv", "intensity,num_yes,num_trials\n0.5,1,10\n2,9,10\n");
  EXPECT_TRUE(document(fit(words).out)["warnings"].empty()) << "they rise";
}

TEST_F(FitCommandTest, AnswersOfSeveralPeopleInOneCurveAreWarnedOf) {
  table("p.csv",
        "participant,condition,intensity,num_yes,num_trials\n"
        "A,d,4,2,20\nA,d,8,9,20\nA,d,14,18,20\nB,d,4,3,20\nB,d,8,10,20\nB,d,14,19,20\n"
        "B,e,4,2,20\nB,e,8,11,20\nB,e,14,18,20\n");
  const auto warnings = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"weber", "--csv", "p.csv", "--reference", "8"};
    words.insert(words.end(), more.begin(), more.end());
    return document(fit(words).out);
  };
  const auto pooled = warnings({})["warnings"];
  ASSERT_EQ(pooled.size(), 2U) << pooled;
  const std::string people = pooled[0], conditions = pooled[1];
  EXPECT_NE(people.find("2 participants are added up"), std::string::npos) << people;
  EXPECT_NE(people.find("--group-by participant fits"), std::string::npos) << people;
  EXPECT_NE(people.find("jnd fit hierarchical"), std::string::npos) << people;
  EXPECT_NE(conditions.find("2 conditions"), std::string::npos) << conditions;
  const auto groups = warnings({"--group-by", "condition"})["groups"];
  ASSERT_EQ(groups[0]["warnings"].size(), 1U);
  EXPECT_NE(
      groups[0]["warnings"][0].get<std::string>().find("--group-by condition,participant fits"),
      std::string::npos);
  EXPECT_TRUE(groups[1]["warnings"].empty()) << "one person's";
  const auto alone = warnings({"--group-by", "participant,condition"});
  ASSERT_EQ(alone["groups"].size(), 3U);
  for (const auto& group : alone["groups"]) {
    EXPECT_TRUE(group["warnings"].empty());
  }
  EXPECT_NE(fit({"weber", "--csv", "p.csv", "--reference", "8"}, false)
                .out.find("note: the answers of 2 participants"),
            std::string::npos);
}

/// The true w is .2, with 5 % lapses at both ends. Without lapses in the model it is .42 (.32
/// .. .59).
TEST_F(FitCommandTest, LapsesThatAreNotInTheModelAreWarnedOf) {
  table("l.csv",
        "intensity,num_yes,num_trials\n"
        "0.5,2,20\n0.65,2,20\n0.8,3,20\n0.9,4,20\n1.1,15,20\n1.25,17,20\n1.5,18,20\n2,19,20\n");
  const auto warnings = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"weber", "--csv", "l.csv", "--reference", "1"};
    words.insert(words.end(), more.begin(), more.end());
    return document(fit(words).out)["warnings"].dump();
  };
  for (const char* overdispersion : {"none", "scaled", "beta-binomial"}) {
    EXPECT_NE(
        warnings({"--overdispersion", overdispersion}).find("hangs on there being no lapses"),
        std::string::npos)
        << overdispersion;
  }
  EXPECT_EQ(warnings({"--free", "lapse"}).find("no lapses"), std::string::npos);
  EXPECT_EQ(warnings({"--lapse", "0.05"}).find("no lapses"), std::string::npos);
  table("l.csv", "intensity,num_yes,num_trials\n1.031,26,59\n1.228,5,11\n");
  EXPECT_NE(warnings({"--lapse", "free"}).find("looks like a lapse"), std::string::npos);
}

/// Three rounds have "yes" at every level, then three have "no".
TEST_F(FitCommandTest, SingleAnswersThatScatterAreWarnedOfWhateverTheInterval) {
  std::string text = "intensity,num_yes,num_trials\n";
  for (int round = 0; round < 24; ++round) {
    for (const char* level : {"0.5", "0.8", "1.25", "2"}) {
      const bool high = level[0] != '0';
      const bool yes = round < 12 ? high || round % 3 > 0 : high && round % 3 == 0;
      text += std::string(level) + (yes ? ",1,1\n" : ",0,1\n");
    }
  }
  table("s.csv", text);
  for (const char* overdispersion : {"none", "scaled"}) {
    const std::string warnings =
        document(fit({"weber", "--csv", "s.csv", "--reference", "1", "--free", "pse",
                      "--overdispersion", overdispersion})
                     .out)["warnings"]
            .dump();
    EXPECT_NE(warnings.find("the Weber fraction itself is too large"), std::string::npos)
        << overdispersion << warnings;
    EXPECT_EQ(warnings.find("every row is a single answer") != std::string::npos,
              std::string(overdispersion) == "scaled");
  }
}

TEST_F(FitCommandTest, RowsOfSeveralPeopleInOnePowerLawAreWarnedOf) {
  table("m.csv",
        "participant,intensity,magnitude\n"
        "A,1,10\nA,2,15\nA,4,22\nB,1,14\nB,2,25\nB,4,41\n");
  const std::string pooled = document(fit({"power", "--csv", "m.csv"}).out)["warnings"].dump();
  EXPECT_NE(pooled.find("2 participants are taken as independent"), std::string::npos);
  const auto alone =
      document(fit({"power", "--csv", "m.csv", "--group-by", "participant"}).out);
  for (const auto& group : alone["groups"]) {
    EXPECT_TRUE(group["warnings"].empty());
  }
}

/// Returns magnitudes of four people at four intensities, each with an exponent of their own.
std::string magnitudes_of_people() {
  std::string text = "who,condition,intensity,magnitude\n";
  const char* rows[4][4] = {{"10", "14", "23", "30"},
                            {"8", "15", "26", "52"},
                            {"30", "41", "55", "83"},
                            {"12", "24", "45", "80"}};
  const char* intensities[4] = {"1", "2", "4", "8"};
  for (int person = 0; person < 4; ++person) {
    for (int i = 0; i < 4; ++i) {
      text +=
          "P" + std::to_string(person) + ",A," + intensities[i] + "," + rows[person][i] + "\n";
    }
  }
  return text;
}

TEST_F(FitCommandTest, PowerLawOfAGroupHasTheGroupsExponentAndEverybodys) {
  table("p.csv", magnitudes_of_people());
  const ProgramOutcome outcome = fit({"power", "--csv", "p.csv", "--participant", "who"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  for (const char* key :
       {"status", "reason", "method", "k", "a", "k_standard_error", "a_standard_error",
        "k_ci95", "a_ci95", "interval_method", "degrees_of_freedom", "between_people",
        "residual_sd_ln", "log_likelihood", "people", "num_people", "num_rows", "excluded",
        "warnings"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["method"], "reml");
  EXPECT_EQ(json["interval_method"], "t");
  EXPECT_EQ(json["degrees_of_freedom"], 3);
  ASSERT_EQ(json["people"].size(), 4U);
  // If everybody judged the same stimuli, the group's exponent is the mean of the own ones, and
  // its interval is that of the mean.
  const auto alone =
      document(fit({"power", "--csv", "p.csv", "--method", "loglog", "--group-by", "who"})
                   .out)["groups"];
  double mean = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(json["people"][i]["participant"], alone[i]["group"]["who"]);
    EXPECT_NEAR(json["people"][i]["own_a"].get<double>(), alone[i]["a"].get<double>(), 1e-9);
    mean += alone[i]["a"].get<double>() / 4.0;
  }
  for (const auto& one : alone) squares += std::pow(one["a"].get<double>() - mean, 2);
  EXPECT_NEAR(json["a"].get<double>(), mean, 1e-8);
  const double error = std::sqrt(squares / 3.0 / 4.0);
  EXPECT_NEAR(json["a_standard_error"].get<double>(), error, 1e-6);
  EXPECT_NEAR(json["a_ci95"][1].get<double>(), mean + 3.182446 * error, 1e-5);
  for (std::size_t i = 0; i < 4; ++i) {
    const double own = json["people"][i]["own_a"], shrunk = json["people"][i]["a"];
    EXPECT_LT(std::fabs(shrunk - mean), std::fabs(own - mean) + 0.02) << i;
  }
}

TEST_F(FitCommandTest, PowerLawOfAGroupIsToldInWords) {
  std::string text = magnitudes_of_people() + "P0,A,0,0\nP1,A,16,0\n";
  table("p.csv", text);
  const std::string told = fit({"power", "--csv", "p.csv", "--participant", "who"}, false).out;
  EXPECT_NE(told.find("S = k I^a of 4 participants, 16 rows"), std::string::npos) << told;
  EXPECT_NE(told.find("left out line 18: the intensity has no logarithm"), std::string::npos);
  EXPECT_NE(told.find("left out line 19: the magnitude has no logarithm"), std::string::npos);
  EXPECT_NE(told.find("Student's t with 3 degrees of freedom"), std::string::npos) << told;
  EXPECT_NE(told.find("standard deviation between participants: a "), std::string::npos);
  EXPECT_NE(told.find("\n  P3 "), std::string::npos) << told;
  const auto groups = document(
      fit({"power", "--csv", "p.csv", "--participant", "who", "--group-by", "condition"}).out);
  EXPECT_EQ(groups["groups"][0]["group"]["condition"], "A");
  EXPECT_EQ(groups["groups"][0]["num_people"], 4);
}

TEST_F(FitCommandTest, PowerLawOfAGroupRefusesWhatDoesNotGoTogether) {
  table("p.csv", magnitudes_of_people());
  const auto refused = [&](std::vector<std::string> more, int exit_code, const char* sentence) {
    std::vector<std::string> words = {"power", "--csv", "p.csv"};
    words.insert(words.end(), more.begin(), more.end());
    const ProgramOutcome outcome = fit(words);
    EXPECT_EQ(outcome.exit_code, exit_code) << outcome.out;
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
  };
  refused({"--participant", "who", "--method", "nls"}, 2, "expected --method loglog or none");
  refused({"--participant", "who", "--shift", "threshold"}, 2, "expected without --shift");
  refused({"--participant", "who", "--group-by", "who"}, 2,
          "expected columns other than that of --participant, found who");
  refused({"--participant", "person"}, 1, "person");
  refused({"--participant", "condition"}, 1, "at least 3 participants");
  EXPECT_EQ(
      fit({"power", "--csv", "p.csv", "--participant", "who", "--method", "loglog"}).exit_code,
      0);
}

TEST_F(FitCommandTest, AnotherReferenceInTheTableIsWarnedOf) {
  table("r.csv",
        "reference,intensity,num_yes,num_trials\n"
        "8,4,2,20\n8.0,8,9,20\n10,14,18,20\n");
  const auto warnings = [&](const char* reference) {
    return document(fit({"weber", "--csv", "r.csv", "--reference", reference}).out)["warnings"];
  };
  const auto of_8 = warnings("8");
  ASSERT_EQ(of_8.size(), 1U) << of_8;
  const std::string words = of_8[0];
  EXPECT_NE(words.find("has 10, and is not used"), std::string::npos) << words;
  table("r.csv", "reference,intensity,num_yes,num_trials\n8,4,2,20\n8.0,14,18,20\n");
  EXPECT_TRUE(warnings("8").empty());
}

TEST_F(FitCommandTest, LapsesAreOfTheUpperEndUnlessTheyAreSymmetric) {
  table("f.csv", kForced);
  const auto told = [&](std::vector<std::string> more) {
    const std::vector<std::string> words = {"weber",  "--csv", "f.csv",   "--reference", "1",
                                            "--free", "pse",   "--guess", "0.5"};
    more.insert(more.begin(), words.begin(), words.end());
    return document(fit(more).out);
  };
  EXPECT_EQ(told({"--lapse", "0.02"})["lapse_rate"], 0.02);
  EXPECT_EQ(told({"--lapse", "0.02"})["lapses_at"], "upper end");
  EXPECT_EQ(told({"--lapse", "0.02", "--symmetric"})["lapses_at"], "both ends");
  EXPECT_EQ(told({"--lapse", "free"})["status"], "ok");
  EXPECT_EQ(told({"--free", "lapse"})["lapses_at"], "both ends") << "as it always was";
}

TEST_F(FitCommandTest, OverdispersionIsAskedForByName) {
  table("s.csv",
        "intensity,num_yes,num_trials\n0.5,2,40\n0.65,15,40\n0.8,9,40\n1,25,40\n1.25,19,40\n"
        "1.6,37,40\n2.2,34,40\n");
  const auto told = [&](const char* how) {
    return document(fit({"weber", "--csv", "s.csv", "--reference", "1", "--free", "pse",
                         "--overdispersion", how})
                        .out);
  };
  const auto none = told("none"), scaled = told("scaled"), beta = told("beta-binomial");
  EXPECT_NE(none["warnings"].dump().find("--overdispersion scaled"), std::string::npos);
  EXPECT_EQ(scaled["overdispersion"]["model"], "scaled");
  EXPECT_GT(scaled["overdispersion"]["factor"].get<double>(), 2.0);
  EXPECT_GT(beta["overdispersion"]["correlation"].get<double>(), 0.02);
  for (const auto& one : {scaled, beta}) {
    EXPECT_LT(one["weber_fraction_ci95"][0], none["weber_fraction_ci95"][0]);
    EXPECT_GT(one["weber_fraction_ci95"][1], none["weber_fraction_ci95"][1]);
    EXPECT_EQ(one["warnings"].dump().find("too narrow"), std::string::npos);
  }
}

TEST_F(FitCommandTest, AGaussianBelowZeroHasItsCurveButNoWeberFraction) {
  table("g.csv", "intensity,num_yes,num_trials\n1,12,20\n2,14,20\n3,15,20\n");
  const std::vector<std::string> words = {"weber", "--csv",    "g.csv", "--reference",
                                          "2",     "--family", "gauss"};
  const ProgramOutcome outcome = fit(words);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_TRUE(json["weber_fraction"].is_null());
  EXPECT_NE(json["reason"].get<std::string>().find("not above 0"), std::string::npos);
  EXPECT_LT(json["parameters"]["mean"], 0.0);
  EXPECT_GT(json["parameters"]["standard_deviation"], 0.0);
  EXPECT_NE(fit(words, false).out.find("Weber fraction  none: the pse is not above 0"),
            std::string::npos);
}

TEST_F(FitCommandTest, HelpShowsListsAsTheyAreTakenAndWhatALapseRateIs) {
  const std::string weber = fit({"weber", "--help"}, false).out;
  EXPECT_EQ(weber.find("..."), std::string::npos) << weber;
  EXPECT_NE(weber.find("pse,lapse"), std::string::npos) << weber;
  EXPECT_NE(weber.find("lapse + (1 - 2 lapse) F"), std::string::npos) << weber;
  EXPECT_NE(weber.find("(x84.13 - pse) / pse"), std::string::npos) << weber;
  const std::string between = fit({"between", "--help"}, false).out;
  EXPECT_EQ(between.find("..."), std::string::npos) << between;
}

}  // namespace fit_test
}  // namespace jnd::app
