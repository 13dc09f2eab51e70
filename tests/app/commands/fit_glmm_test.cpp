#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "app/commands/fit_fixture.h"
#include "app/json_document.h"
#include "support/files.h"

namespace jnd::app {
namespace fit_glmm_test {

using test_support::ProgramOutcome;
using Words = std::vector<std::string>;

/// Counts of 20 trials for four people at five levels of two conditions.
std::string counts() {
  std::string text = "participant,condition,u,k,n\n";
  const int yes[4][2][5] = {{{1, 3, 8, 15, 19}, {2, 6, 12, 18, 20}},
                            {{0, 4, 11, 17, 20}, {3, 8, 15, 18, 20}},
                            {{2, 3, 6, 11, 16}, {1, 5, 9, 14, 19}},
                            {{1, 5, 12, 16, 18}, {4, 9, 14, 19, 20}}};
  for (int p = 0; p < 4; ++p) {
    for (int c = 0; c < 2; ++c) {
      for (int i = 0; i < 5; ++i) {
        text += "P" + std::to_string(p) + (c == 0 ? ",A," : ",B,") + std::to_string(i + 1) +
                "," + std::to_string(yes[p][c][i]) + ",20\n";
      }
    }
  }
  return text;
}

class FitGlmm : public FitFixture {
 protected:
  ProgramOutcome glmm(Words words, bool as_json = true) {
    words.insert(words.begin(), "glmm");
    return fit(words, as_json);
  }
  /// Fits the table of `counts` with additional words.
  ProgramOutcome of_counts(const Words& more, bool as_json = true) {
    table("c.csv", counts());
    Words words = {"--csv", "c.csv", "--yes", "k", "--trials", "n"};
    words.insert(words.end(), more.begin(), more.end());
    return glmm(words, as_json);
  }
};

const Words kModel = {"--fixed", "u * condition", "--random", "1 + u | participant"};

Words with(Words words) {
  words.insert(words.begin(), kModel.begin(), kModel.end());
  return words;
}

TEST_F(FitGlmm, PrintsTheKeysOfTheContract) {
  const ProgramOutcome outcome = of_counts(with({"--stimulus", "u"}));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["status"], "ok");
  EXPECT_TRUE(json["reason"].is_null());
  ASSERT_EQ(json["fixed"].size(), 4U);
  EXPECT_EQ(json["fixed"][0]["name"], "(Intercept)");
  EXPECT_EQ(json["fixed"][3]["name"], "u:conditionB");
  for (const char* key : {"estimate", "standard_error", "z", "p"}) {
    EXPECT_TRUE(json["fixed"][1][key].is_number()) << key;
  }
  ASSERT_EQ(json["random"].size(), 2U);
  EXPECT_EQ(json["random"][1]["group"], "participant");
  EXPECT_EQ(json["random"][1]["name"], "u");
  EXPECT_EQ(json["random"][1]["correlations"].size(), 1U);
  EXPECT_EQ(json["num_rows"], 40);
  EXPECT_EQ(json["groups"]["participant"], 4);
  // There are three quantities for each condition, and their differences.
  ASSERT_EQ(json["derived"].size(), 9U);
  EXPECT_EQ(json["derived"][0]["name"], "PSE, condition A");
  const double a = json["fixed"][0]["estimate"], b = json["fixed"][1]["estimate"];
  EXPECT_NEAR(json["derived"][0]["value"].get<double>(), -a / b, 1e-9);
  EXPECT_NEAR(json["derived"][1]["value"].get<double>(), 0.6744897501960817 / b, 1e-9);
  EXPECT_LT(json["derived"][0]["ci95"][0], json["derived"][0]["value"]);
  EXPECT_NEAR(json["aic"].get<double>(), 14.0 - 2.0 * json["log_likelihood"].get<double>(),
              1e-9);
}

TEST_F(FitGlmm, TellsPeopleWhatItTellsPrograms) {
  const ProgramOutcome outcome =
      of_counts(with({"--stimulus", "u", "--bootstrap", "30"}), false);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const char* words :
       {"(Intercept)", "u:conditionB", "4 groups of participant", "PSE, condition A",
        "JND, condition B - condition A", "Weber fraction", "bootstrap", "log-likelihood",
        "Laplace", "AIC"}) {
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words << outcome.out;
  }
}

TEST_F(FitGlmm, TrialsAndTheirCountsAreTheSameAnswers) {
  std::string trials = "participant,condition,u,answer\n";
  std::istringstream lines(counts());
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) {
    const std::size_t last = line.rfind(','), before = line.rfind(',', last - 1);
    const int yes = std::stoi(line.substr(before + 1));
    for (int i = 0; i < 20; ++i) {
      trials += line.substr(0, before) + (i < yes ? ",yes\n" : ",no\n");
    }
  }
  table("t.csv", trials);
  Words words = {"--csv", "t.csv", "--yes", "answer"};
  words.insert(words.end(), kModel.begin(), kModel.end());
  const auto of_trials = document(glmm(words).out), json = document(of_counts(kModel).out);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(of_trials["fixed"][i]["estimate"].get<double>(),
                json["fixed"][i]["estimate"].get<double>(), 1e-6);
  }
  EXPECT_EQ(of_trials["num_rows"], 800);
}

TEST_F(FitGlmm, PointsIntoAFormulaThatIsWrong) {
  const ProgramOutcome open = of_counts({"--fixed", "u * ", "--random", "1 | participant"});
  EXPECT_EQ(open.exit_code, 2);
  EXPECT_NE(open.err.find("--fixed: expected the name of a column, found the end\n  u * \n"
                          "      ^"),
            std::string::npos)
      << open.err;
  const ProgramOutcome unknown =
      of_counts({"--fixed", "u + speed", "--random", "1 | participant"});
  EXPECT_EQ(unknown.exit_code, 2);
  EXPECT_NE(unknown.err.find("  u + speed\n      ^"), std::string::npos) << unknown.err;
  EXPECT_NE(unknown.err.find("participant, condition, u, k, n"), std::string::npos)
      << unknown.err;
  const ProgramOutcome group = of_counts({"--fixed", "u", "--random", "1 | person"});
  EXPECT_EQ(group.exit_code, 2);
  EXPECT_NE(group.err.find("--random: "), std::string::npos) << group.err;
  EXPECT_NE(group.err.find("  1 | person\n      ^"), std::string::npos) << group.err;
}

TEST_F(FitGlmm, RefusesWhatDoesNotGoTogether) {
  for (const Words& wrong :
       {Words{"--script", "python"}, Words{"--terms", "history"}, Words{"--bootstrap", "9"},
        Words{"--jnd-at", "0.5"}, Words{"--guess", "0.5", "--lapse", "0.5"},
        Words{"--stimulus", "speed"}, Words{"--stimulus", "condition"},
        Words{"--link", "cauchit"}, Words{"--nodes", "0"}}) {
    const ProgramOutcome outcome = of_counts(with(wrong), false);
    EXPECT_EQ(outcome.exit_code, 2) << wrong.front() << outcome.out;
    EXPECT_FALSE(outcome.err.empty());
  }
  const ProgramOutcome python = of_counts(with({"--script", "python"}), false);
  EXPECT_NE(python.err.find("statsmodels"), std::string::npos) << python.err;
  // Quadrature allows only one grouping, and terms of history need single trials in their
  // order.
  EXPECT_EQ(of_counts({"--fixed", "u", "--random", "(1 | participant) + (1 | condition)",
                       "--nodes", "5"})
                .exit_code,
            1);
  EXPECT_EQ(of_counts(with({"--stimulus", "u", "--terms", "history"})).exit_code, 1);
}

TEST_F(FitGlmm, SaysWhatMakesItTooSure) {
  const ProgramOutcome same = of_counts(with({}), false);
  EXPECT_NE(same.out.find("takes the effect of condition as the same in each participant"),
            std::string::npos)
      << same.out;
  EXPECT_NE(same.out.find("with 4 of participant they are somewhat too sure"),
            std::string::npos);
  const ProgramOutcome differ = of_counts(
      {"--fixed", "u * condition", "--random", "1 + u + condition | participant"}, false);
  EXPECT_EQ(differ.out.find("as the same in each"), std::string::npos) << differ.out;
}

TEST_F(FitGlmm, RightAnswersAskForTheirChance) {
  std::string text = counts();
  text.replace(text.find(",k,"), 3, ",correct,");
  table("r.csv", text);
  Words words = {"--csv", "r.csv", "--yes", "correct", "--trials", "n"};
  words.insert(words.end(), kModel.begin(), kModel.end());
  const ProgramOutcome asked = glmm(words, false);
  EXPECT_EQ(asked.exit_code, 2);
  EXPECT_NE(asked.err.find("correct sounds like right answers"), std::string::npos)
      << asked.err;
  words.insert(words.end(), {"--guess", "0"});
  EXPECT_EQ(glmm(words, false).exit_code, 0);
}

TEST_F(FitGlmm, SeparatedAnswersAreSaidSo) {
  table("s.csv", "p,u,k,n\na,1,0,9\na,2,9,9\nb,1,0,9\nb,2,9,9\n");
  const ProgramOutcome outcome = glmm(
      {"--csv", "s.csv", "--yes", "k", "--trials", "n", "--fixed", "u", "--random", "1 | p"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto json = document(outcome.out);
  EXPECT_EQ(json["status"], "degenerate");
  EXPECT_TRUE(json["log_likelihood"].is_null());
  EXPECT_NE(outcome.err.find("separated"), std::string::npos);
}

TEST_F(FitGlmm, HistoryAddsTheTrialBefore) {
  std::string trials = "p,u,y\n";
  for (int i = 0; i < 90; ++i) {
    const int u = (i * 7) % 5;
    trials += std::string(i % 3 == 0   ? "a"
                          : i % 3 == 1 ? "b"
                                       : "c") +
              "," + std::to_string(u) + "," + ((u * 13 + i * 5) % 9 > 4 ? "1" : "0") + "\n";
  }
  table("h.csv", trials);
  const ProgramOutcome outcome =
      glmm({"--csv", "h.csv", "--yes", "y", "--fixed", "u", "--random", "1 | p", "--stimulus",
            "u", "--terms", "history"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_EQ(json["num_rows"], 87);
  ASSERT_EQ(json["fixed"].size(), 4U);
  EXPECT_EQ(json["fixed"][2]["name"], "previous_u");
  EXPECT_EQ(json["fixed"][3]["name"], "previous_answer");
  EXPECT_NE(json["notes"].dump().find("3 rows"), std::string::npos);
}

TEST_F(FitGlmm, EachGroupHasAFitOfItsOwn) {
  const Words model = {"--fixed", "u", "--random", "1 + u | participant", "--stimulus", "u"};
  const auto alone = [&](const char* where) {
    Words words = model;
    words.insert(words.end(), {"--where", where});
    return document(of_counts(words).out);
  };
  Words words = model;
  words.insert(words.end(), {"--group-by", "condition"});
  const ProgramOutcome outcome = of_counts(words);
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  ASSERT_EQ(json["fits"].size(), 2U);
  EXPECT_EQ(json["num_rows_in_file"], 40);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto& fit = json["fits"][i];
    EXPECT_EQ(fit["group"]["condition"], i == 0 ? "A" : "B");
    const auto other = alone(i == 0 ? "condition=A" : "condition=B");
    for (const char* key : {"fixed", "random", "log_likelihood", "derived", "num_rows"}) {
      EXPECT_EQ(fit[key], other[key]) << key;
    }
  }
  const std::string told = of_counts(words, false).out;
  EXPECT_EQ(told.find("condition A\n"), 0U) << told;
  EXPECT_NE(told.find("\ncondition B\n"), std::string::npos) << told;
}

TEST_F(FitGlmm, AGroupWithoutAFitLeavesTheOthersTheirs) {
  std::string text = counts();
  text += "P0,C,1,0,20\nP0,C,2,20,20\nP1,C,1,0,20\nP1,C,2,20,20\n";
  text += "P0,D,1,3,20\nP0,D,2,9,20\nP0,D,3,16,20\n";
  table("g.csv", text);
  const ProgramOutcome outcome =
      glmm({"--csv", "g.csv", "--yes", "k", "--trials", "n", "--fixed", "u", "--random",
            "1 | participant", "--group-by", "condition"});
  EXPECT_EQ(outcome.exit_code, 1);
  const auto json = document(outcome.out);
  ASSERT_EQ(json["fits"].size(), 4U);
  EXPECT_EQ(json["fits"][0]["status"], "ok");
  EXPECT_EQ(json["fits"][1]["status"], "ok");
  EXPECT_EQ(json["fits"][2]["status"], "degenerate") << "separated";
  EXPECT_EQ(json["fits"][3]["status"], "degenerate") << "one participant";
  EXPECT_NE(outcome.err.find("expected a mixed model in every group, found none in 2 of 4"),
            std::string::npos)
      << outcome.err;
}

TEST_F(FitGlmm, GroupsAreByColumnsThatNoFormulaNames) {
  const auto refused = [&](const Words& more, const char* sentence) {
    const ProgramOutcome outcome = of_counts(with(more));
    EXPECT_EQ(outcome.exit_code, 2) << more.front();
    EXPECT_NE(outcome.err.find(sentence), std::string::npos) << outcome.err;
  };
  refused({"--group-by", "condition"},
          "expected columns that no formula names, found condition");
  refused({"--group-by", "colour"}, "--group-by: expected a column of participant, condition");
  table("c.csv", counts());
  for (const Words& wrong :
       {Words{"--script", "r"}, Words{"--stimulus", "u", "--figure", path("f.svg").string()}}) {
    Words words = {"--csv",      "c.csv",    "--yes", "k",        "--trials",
                   "n",          "--fixed",  "u",     "--random", "1 | participant",
                   "--group-by", "condition"};
    words.insert(words.end(), wrong.begin(), wrong.end());
    const ProgramOutcome outcome = glmm(words, false);
    EXPECT_EQ(outcome.exit_code, 2) << wrong.front();
    EXPECT_NE(outcome.err.find("expected without --group-by"), std::string::npos)
        << outcome.err;
  }
}

/// Returns the number behind "NAME " at the beginning of a line or behind a comma.
double printed(const std::string& text, const std::string& name) {
  for (const char* before : {"\n", ", "}) {
    const std::string words = before + name + " ";
    const std::size_t at = text.find(words);
    if (at != std::string::npos) return std::stod(text.substr(at + words.size()));
  }
  return std::nan("");
}

TEST_F(FitGlmm, ItsScriptFindsTheSame) {
  const std::string program = test_support::installed_program("Rscript");
  if (program.empty()) GTEST_SKIP() << "R is not installed";
  test_support::ProgramOptions there = options_;
  there.program = program;
  if (test_support::run_program({"-e", "library(lme4)"}, there).exit_code != 0) {
    GTEST_SKIP() << "lme4 is not installed";
  }
  for (const Words& words :
       {with({"--stimulus", "u"}),
        Words{"--fixed", "scale(u) + condition", "--random", "1 | participant", "--link",
              "logit", "--nodes", "9", "--contrasts", "sum"},
        Words{"--fixed", "u", "--random", "1 | participant", "--lapse", "0.02", "--where",
              "condition=A"}}) {
    const auto json = document(of_counts(words).out);
    Words scripted = words;
    scripted.insert(scripted.end(), {"--script", "r"});
    const ProgramOutcome script = of_counts(scripted, false);
    ASSERT_EQ(script.exit_code, 0) << script.err;
    table("s.R", script.out);
    const ProgramOutcome outcome = test_support::run_program({"s.R"}, there);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err << script.out;
    const double log_likelihood = json["log_likelihood"];
    EXPECT_NEAR(printed(outcome.out, "log_likelihood"), log_likelihood, 1e-3) << script.out;
    // The table of all fixed effects follows the summary.
    const std::string effects = outcome.out.substr(outcome.out.rfind("\n(Intercept) "));
    for (const auto& effect : json["fixed"]) {
      const double estimate = effect["estimate"], error = effect["standard_error"];
      EXPECT_NEAR(printed(effects, effect["name"]), estimate, 0.01 * error) << outcome.out;
    }
  }
}

}  // namespace fit_glmm_test
}  // namespace jnd::app
