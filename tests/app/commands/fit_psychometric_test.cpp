#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "app/commands/fit_fixture.h"
#include "app/json_document.h"
#include "support/files.h"

namespace jnd::app {
namespace fit_psychometric_test {

using test_support::ProgramOutcome;

class FitPsychometric : public FitFixture {
 protected:
  ProgramOutcome psychometric(std::vector<std::string> words, bool as_json = true) {
    words.insert(words.begin(), "psychometric");
    return fit(words, as_json);
  }
};

constexpr char kSigned[] =
    "soa,k,n,condition\n-60,2,30,a\n-30,6,30,a\n0,13,30,a\n30,22,30,a\n60,27,30,a\n"
    "-60,1,30,b\n-30,3,30,b\n0,7,30,b\n30,16,30,b\n60,25,30,b\n";
const std::vector<std::string> kColumns = {"--csv", "a.csv", "--intensity", "soa",
                                           "--yes", "k",     "--trials",    "n"};

std::vector<std::string> with(std::vector<std::string> words) {
  words.insert(words.begin(), kColumns.begin(), kColumns.end());
  return words;
}

TEST_F(FitPsychometric, PrintsTheKeysOfTheContract) {
  table("a.csv", kSigned);
  const ProgramOutcome outcome =
      psychometric(with({"--group-by", "condition", "--at", "0.75,0.84"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  ASSERT_EQ(json["fits"].size(), 2U);
  const auto& fit = json["fits"][0];
  for (const char* key : {"group", "status", "reason", "num_trials", "location", "scale",
                          "guess_rate", "lapse_rate", "thresholds", "jnd", "log_likelihood",
                          "deviance", "aic", "bic", "overdispersion", "warnings"}) {
    EXPECT_TRUE(fit.contains(key)) << key;
  }
  EXPECT_EQ(fit["group"]["condition"], "a");
  EXPECT_EQ(fit["num_trials"], 150);
  ASSERT_EQ(fit["thresholds"].size(), 2U);
  EXPECT_EQ(fit["thresholds"][0]["at"], 0.75);
  const double value = fit["thresholds"][0]["value"];
  const double location = fit["location"], scale = fit["scale"];
  EXPECT_NEAR(value, location + 0.6744897501960817 * scale, 1e-9);
  EXPECT_LT(fit["thresholds"][0]["ci95"][0], value);
  EXPECT_GT(fit["thresholds"][0]["ci95"][1], value);
}

TEST_F(FitPsychometric, AThresholdIsAskedForByTheProportionAsAnswered) {
  // With two alternatives, 75 % right is half way up the curve, and 87.5 % is three quarters of
  // the way.
  table("a.csv", "x,r,n\n1,52,100\n2,58,100\n3,75,100\n4,92,100\n5,99,100\n");
  const std::vector<std::string> words = {
      "--csv", "a.csv", "--intensity", "x", "--yes", "r", "--trials", "n", "--task", "mafc:2"};
  const auto run = [&](std::vector<std::string> more, bool as_json = true) {
    more.insert(more.begin(), words.begin(), words.end());
    return psychometric(more, as_json);
  };
  const auto by_level = document(run({"--at", "0.5,0.75"}).out);
  const auto by_proportion = document(run({"--at-proportion", "0.75,0.875"}).out);
  EXPECT_EQ(by_level["fits"][0]["thresholds"], by_proportion["fits"][0]["thresholds"]);
  const auto both = document(run({"--at", "0.9", "--at-proportion", "0.75"}).out);
  EXPECT_EQ(both["fits"][0]["thresholds"].size(), 2U);

  const ProgramOutcome free = run({"--lapse", "free", "--at-proportion", "0.75"}, false);
  EXPECT_EQ(free.exit_code, 0) << free.err;
  EXPECT_NE(free.out.find("threshold 75 %"), std::string::npos) << free.out;
  const ProgramOutcome refused = run({"--at-proportion", "0.4"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_NE(refused.err.find("between 0.5, the lower end of the curve, and 1, its upper end"),
            std::string::npos)
      << refused.err;
}

TEST_F(FitPsychometric, TellsPeopleWhatItTellsPrograms) {
  table("a.csv", kSigned);
  const ProgramOutcome outcome =
      psychometric(with({"--group-by", "condition", "--compare"}), false);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* words : {"condition a", "PSE", "JND", "threshold 0.5", "comparison",
                            "different location, same scale", "Holm"}) {
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words;
  }
}

TEST_F(FitPsychometric, FindsThatAnswersFallAndSaysSo) {
  table("a.csv", "x,r,n\n-2,28,30\n-1,24,30\n0,16,30\n1,6,30\n2,2,30\n");
  const std::vector<std::string> words = {"--csv", "a.csv", "--intensity", "x",
                                          "--yes", "r",     "--trials",    "n"};
  const auto json = document(psychometric(words).out);
  EXPECT_EQ(json["fits"][0]["falling"], true);
  EXPECT_NE(json["notes"].dump().find("fall"), std::string::npos);
  std::vector<std::string> rising = words;
  rising.emplace_back("--rising");
  EXPECT_EQ(psychometric(rising).exit_code, 1);
}

TEST_F(FitPsychometric, AsksWhetherAnswersAreRightOnes) {
  table("a.csv",
        "intensity,num_yes,num_trials\n1,52,100\n2,58,100\n3,75,100\n4,92,100\n5,99,100\n");
  const ProgramOutcome asked = psychometric({"--csv", "a.csv"});
  EXPECT_EQ(asked.exit_code, 2);
  EXPECT_NE(asked.err.find("--task mafc:2"), std::string::npos) << asked.err;
  const auto json = document(
      psychometric({"--csv", "a.csv", "--task", "mafc:2", "--at", "0.75", "--lapse", "free"})
          .out);
  EXPECT_EQ(json["fits"][0]["guess_rate"], 0.5);
  EXPECT_NEAR(json["fits"][0]["thresholds"][0]["proportion"].get<double>(),
              0.5 + 0.75 * (0.5 - json["fits"][0]["lapse_rate"].get<double>()), 1e-12);
  EXPECT_EQ(psychometric({"--csv", "a.csv", "--task", "yes-no"}).exit_code, 0);
}

/// Returns some columns of a table of trials as `jnd export csv` writes it. The answers look
/// like right answers with two alternatives.
std::string exported_trials(const std::string& answered) {
  std::string text =
      "session,block,intensity,reference_intensity,response,is_test_chosen,is_felt,"
      "is_called_different,is_right,excluded\n";
  const int yes[] = {52, 58, 75, 92, 99};
  for (int level = 0; level < 5; ++level) {
    for (int trial = 0; trial < 100; ++trial) {
      const char* answer = trial < yes[level] ? "1" : "0";
      const auto cell = [&](const char* column) {
        return answered == column ? std::string(answer) : std::string();
      };
      text += "1,b," + std::to_string(level + 1) + ",1," + answer + "," +
              cell("is_test_chosen") + "," + cell("is_felt") + "," +
              cell("is_called_different") + "," + cell("is_right") + ",0\n";
    }
  }
  return text;
}

TEST_F(FitPsychometric, KnowsTheTaskOfTrialsThatTheProgramExported) {
  for (const char* column : {"is_test_chosen", "is_felt", "is_called_different"}) {
    table("trials.csv", exported_trials(column));
    const ProgramOutcome outcome = psychometric({"--csv", "trials.csv", "--yes", column});
    ASSERT_EQ(outcome.exit_code, 0) << column << outcome.err;
    EXPECT_EQ(document(outcome.out)["fits"][0]["guess_rate"], 0.0) << column;
  }
  table("trials.csv", exported_trials("is_right"));
  const ProgramOutcome right = psychometric({"--csv", "trials.csv", "--yes", "is_right"});
  EXPECT_EQ(right.exit_code, 2);
  EXPECT_NE(right.err.find("--task mafc:3 if the block's task is three_interval or oddity"),
            std::string::npos)
      << right.err;
  EXPECT_EQ(
      psychometric({"--csv", "trials.csv", "--yes", "is_right", "--task", "mafc:2"}).exit_code,
      0);
  const ProgramOutcome response = psychometric({"--csv", "trials.csv", "--yes", "response"});
  EXPECT_EQ(response.exit_code, 2);
  EXPECT_NE(response.err.find("expected --yes is_test_chosen"), std::string::npos)
      << response.err;
}

TEST_F(FitPsychometric, RefusesWhatDoesNotGoTogether) {
  table("a.csv", kSigned);
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--at", "1.5"},
                                                {"--task", "mafc:1"},
                                                {"--task", "3afc"},
                                                {"--compare"},
                                                {"--falling", "--rising"},
                                                {"--guess", "free", "--symmetric"},
                                                {"--guess", "0.5", "--lapse", "0.5"},
                                                {"--task", "mafc:2", "--guess", "0.25"},
                                                {"--jnd-at", "0.5"},
                                                {"--where", "condition"}}) {
    const ProgramOutcome outcome = psychometric(with(wrong));
    EXPECT_EQ(outcome.exit_code, 2) << wrong.front();
    EXPECT_FALSE(outcome.err.empty());
  }
  EXPECT_EQ(psychometric(with({"--axis", "log"})).exit_code, 1);
}

TEST_F(FitPsychometric, PrintsATableWithARowForEachThreshold) {
  table("a.csv", kSigned);
  const ProgramOutcome outcome =
      psychometric(with({"--group-by", "condition", "--at", "0.5,0.75", "--as-csv"}), false);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(outcome.out.starts_with("condition,status,reason,num_trials,location,"));
  EXPECT_EQ(std::count(outcome.out.begin(), outcome.out.end(), '\n'), 5);
}

TEST_F(FitPsychometric, DrawsANewFileAndOverwritesNone) {
  if (test_support::installed_program("gnuplot").empty())
    GTEST_SKIP() << "gnuplot is not installed";
  table("a.csv", kSigned);
  for (const char* name : {"a.svg", "a.pdf", "a.png"}) {
    const ProgramOutcome outcome =
        psychometric(with({"--group-by", "condition", "--figure", name}));
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_GT(std::filesystem::file_size(path(name)), 1000U) << name;
    EXPECT_EQ(psychometric(with({"--group-by", "condition", "--figure", name})).exit_code, 1);
  }
  EXPECT_EQ(psychometric(with({"--figure", "a.doc"})).exit_code, 1);
}

/// Returns 1.5 for "location 1.5" in what a script printed about the first group.
double printed(const std::string& text, const std::string& name) {
  const std::size_t at = text.find(name + " ");
  return at == std::string::npos ? std::nan("") : std::stod(text.substr(at + name.size() + 1));
}

TEST_F(FitPsychometric, ItsScriptsFindTheSameCurve) {
  table("a.csv", kSigned);
  table("f.csv", "x,r,n\n0.5,16,30\n1,17,30\n2,20,30\n4,26,30\n8,29,30\n16,28,30\n");
  const std::vector<std::vector<std::string>> fits = {
      with({"--group-by", "condition", "--family", "logistic"}),
      with({"--where", "condition=b", "--family", "gumbel", "--lapse", "free"}),
      {"--csv", "f.csv", "--intensity", "x", "--yes", "r", "--trials", "n", "--family",
       "weibull", "--task", "mafc:2", "--lapse", "free"}};
  for (const auto& [language, program, file] :
       {std::array<std::string, 3>{"python", "python3", "s.py"},
        std::array<std::string, 3>{"r", "Rscript", "s.R"}}) {
    const std::string found = test_support::installed_program(program);
    if (found.empty()) continue;
    for (const std::vector<std::string>& words : fits) {
      const auto fit = document(psychometric(words).out)["fits"][0];
      std::vector<std::string> scripted = words;
      scripted.insert(scripted.end(), {"--script", language});
      const ProgramOutcome script = psychometric(scripted, false);
      ASSERT_EQ(script.exit_code, 0) << script.err;
      table(file.c_str(), script.out);
      test_support::ProgramOptions there = options_;
      there.program = found;
      const ProgramOutcome outcome = test_support::run_program({file}, there);
      ASSERT_EQ(outcome.exit_code, 0) << outcome.err << script.out;
      for (const char* name : {"location", "scale", "log_likelihood"}) {
        const double value = fit[name];
        EXPECT_NEAR(printed(outcome.out, name), value, 2e-4 * std::fabs(value))
            << language << outcome.out;
      }
    }
  }
}

TEST_F(FitPsychometric, DetectionTellsSensitivityAndItsCorrection) {
  // After the log-linear correction the rates are 20.5 / 26 and 5.5 / 26.
  table("d.csv", "intensity,num_yes,num_trials\n0,5,25\n1,20,25\n");
  const auto json = document(fit({"detection", "--csv", "d.csv"}).out)["fits"][0];
  EXPECT_NEAR(json["hit_rate"].get<double>(), 20.5 / 26.0, 1e-12);
  EXPECT_NEAR(json["false_alarm_rate"].get<double>(), 5.5 / 26.0, 1e-12);
  // z(20.5 / 26) = -z(5.5 / 26) = 0.80143..., so there is no bias.
  EXPECT_NEAR(json["criterion"].get<double>(), 0.0, 1e-12);
  EXPECT_GT(json["d_prime"].get<double>(), 1.5);
  EXPECT_LT(json["d_prime"].get<double>(), 1.7);
  // A' of the rates 0.8 and 0.2 is 0.5 + 0.6 * 1.6 / (4 * 0.8 * 0.8).
  EXPECT_NEAR(json["a_prime"].get<double>(), 0.875, 1e-12);
  EXPECT_NE(json["correction"].get<std::string>().find("log-linear"), std::string::npos);
  table("e.csv", "intensity,num_yes,num_trials\n1,20,25\n");
  EXPECT_EQ(fit({"detection", "--csv", "e.csv"}).exit_code, 1);
}

TEST_F(FitPsychometric, SameAndDifferentHasACommand) {
  table("s.csv",
        "intensity,num_yes,num_trials\n10,4,40\n11,9,40\n12,18,40\n14,33,40\n17,40,40\n");
  const ProgramOutcome outcome = fit({"same-different", "--csv", "s.csv", "--reference", "10"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out)["fits"][0];
  EXPECT_GT(json["weber_fraction"], 0.0);
  EXPECT_GT(json["criterion_ln"], 0.0);
  EXPECT_EQ(fit({"same-different", "--csv", "s.csv", "--reference", "0"}).exit_code, 2);
}

}  // namespace fit_psychometric_test
}  // namespace jnd::app
