#include <gtest/gtest.h>

#include "app/commands/fit_fixture.h"
#include "app/json_document.h"
#include "support/program.h"

namespace jnd::app {
namespace fit_group_robust_test {

using test_support::ProgramOutcome;

/// Answers of four people, the last of whom answers one trial in three at random.
constexpr char kPeople[] =
    "participant,intensity,num_yes,num_trials\n"
    "A,2,0,40\nA,5,2,40\nA,7,14,40\nA,9,26,40\nA,12,37,40\nA,32,40,40\n"
    "B,2,0,40\nB,5,1,40\nB,7,12,40\nB,9,27,40\nB,12,38,40\nB,32,40,40\n"
    "C,2,1,40\nC,5,3,40\nC,7,15,40\nC,9,25,40\nC,12,36,40\nC,32,40,40\n"
    "D,2,7,40\nD,5,8,40\nD,7,16,40\nD,9,25,40\nD,12,32,40\nD,32,33,40\n";

class FitGroupRobustTest : public FitFixture {
 protected:
  ProgramOutcome hierarchical(const std::vector<std::string>& more, bool as_json = true) {
    table("g.csv", kPeople);
    std::vector<std::string> words = {"hierarchical", "--csv",    "g.csv", "--reference", "8",
                                      "--pse",        "reference"};
    words.insert(words.end(), more.begin(), more.end());
    return fit(words, as_json);
  }
};

TEST_F(FitGroupRobustTest, WithoutTheOptionsNothingOfThemIsTold) {
  const auto json = document(hierarchical({}).out);
  for (const char* key : {"overdispersion", "lapse_angle_sd", "mean_lapse_rate",
                          "common_lapses", "lapse_prior", "prior_sensitivity"}) {
    EXPECT_FALSE(json.contains(key)) << key;
  }
  EXPECT_FALSE(json["participants"][0].contains("lapse_rate"));
  const auto told =
      document(hierarchical({"--overdispersion", "none", "--lapses-by", "common"}).out);
  EXPECT_EQ(told, json);
}

TEST_F(FitGroupRobustTest, OverdispersionTellsACorrelationAndItsTest) {
  const ProgramOutcome outcome = hierarchical({"--overdispersion", "beta-binomial"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  const auto& told = json["overdispersion"];
  EXPECT_GE(told["rho"], 0.0);
  EXPECT_LT(told["rho"], 0.3);
  EXPECT_GT(told["rho_ci95"][1], told["rho"]);
  EXPECT_LE(told["log_likelihood_without"].get<double>(),
            json["log_likelihood"].get<double>() + 0.5);
  EXPECT_LE(told["p_value"], 1.0);
  EXPECT_EQ(told["weber_fractions_without"].size(), 1U);
  const std::string text =
      hierarchical({"--overdispersion", "beta-binomial"}, /*as_json=*/false).out;
  EXPECT_NE(text.find("  overdispersion  "), std::string::npos) << text;
  EXPECT_NE(text.find("without it: likelihood ratio"), std::string::npos) << text;
}

TEST_F(FitGroupRobustTest, PersonalLapsesAreToldOfEachPerson) {
  const ProgramOutcome outcome = hierarchical({"--lapses-by", "personal"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto json = document(outcome.out);
  EXPECT_GT(json["lapse_angle_sd"], 0.05);
  EXPECT_GT(json["mean_lapse_rate"], json["lapse_rate"]);
  ASSERT_EQ(json["participants"].size(), 4U);
  EXPECT_GT(json["participants"][3]["lapse_rate"], 0.08);
  EXPECT_LT(json["participants"][0]["lapse_rate"], 0.05);
  const auto& common = json["common_lapses"];
  EXPECT_TRUE(common["log_likelihood"].is_number());
  EXPECT_TRUE(common["lapse_rate"].is_number());
  EXPECT_LT(common["p_value"], 0.5);
  EXPECT_EQ(common["weber_fractions"].size(), 1U);
  const std::string text = hierarchical({"--lapses-by", "personal"}, /*as_json=*/false).out;
  EXPECT_NE(text.find("of each person: A "), std::string::npos) << text;
  EXPECT_NE(text.find("of the median person; mean of people"), std::string::npos) << text;
  EXPECT_NE(text.find("with one for everybody, "), std::string::npos) << text;
}

TEST_F(FitGroupRobustTest, APriorIsToldWithWhatItMoves) {
  const auto plain = document(hierarchical({}).out);
  auto same = document(hierarchical({"--lapse-prior", "1,20"}).out);
  ASSERT_EQ(same["prior_sensitivity"].size(), 3U);
  EXPECT_EQ(same["lapse_prior"], nlohmann::json::array({1.0, 20.0}));
  EXPECT_EQ(same["prior_sensitivity"][1]["weight"], 0.5);
  EXPECT_EQ(same["prior_sensitivity"][1]["lapse_prior"], nlohmann::json::array({1.0, 10.5}));
  EXPECT_TRUE(same["prior_sensitivity"][0]["weber_fractions"][0].is_number());
  same.erase("prior_sensitivity");
  same.erase("lapse_prior");
  EXPECT_EQ(same, plain) << "Beta(1, 20) is the default";
  const auto strict = document(hierarchical({"--lapse-prior", "1,200"}).out);
  EXPECT_LT(strict["lapse_rate"], plain["lapse_rate"]);
  const std::string text = hierarchical({"--lapse-prior", "1,20"}, /*as_json=*/false).out;
  EXPECT_NE(text.find("Beta(1, 20) of the share of random answers"), std::string::npos) << text;
  EXPECT_NE(text.find("at twice its weight"), std::string::npos) << text;
}

TEST_F(FitGroupRobustTest, WrongUseIsOneSentenceAndExitTwo) {
  const auto refused = [&](const std::vector<std::string>& more, const std::string& words) {
    const ProgramOutcome outcome = hierarchical(more);
    EXPECT_EQ(outcome.exit_code, 2) << more[0];
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
    EXPECT_TRUE(outcome.out.empty());
  };
  for (const char* bad : {"20", "0.5,20", "1,0.5", "1,x", "1,20,3", "nan,20", "1,2e6", ""}) {
    refused({"--lapse-prior", bad}, "--lapse-prior");
  }
  refused({"--lapse-prior", "0.5,20"}, "expected two numbers A,B from 1 to 1000000");
  refused({"--lapse-prior", "1,20", "--lapse", "none"}, "found --lapse none");
  refused({"--lapses-by", "personal", "--lapse", "0.02"}, "found --lapse 0.02");
  refused({"--lapses-by", "own"}, "--lapses-by");
  refused({"--overdispersion", "scaled"}, "--overdispersion");
}

TEST_F(FitGroupRobustTest, SingleAnswersHaveNoOverdispersion) {
  table("s.csv",
        "participant,intensity,num_yes,num_trials\n"
        "A,4,0,1\nA,6,0,1\nA,8,1,1\nA,9,0,1\nA,11,1,1\n"
        "B,4,0,1\nB,6,1,1\nB,8,0,1\nB,9,1,1\nB,11,1,1\n");
  const ProgramOutcome outcome = fit({"hierarchical", "--csv", "s.csv", "--reference", "8",
                                      "--overdispersion", "beta-binomial"});
  EXPECT_EQ(outcome.exit_code, 1);
  EXPECT_NE(outcome.err.find("nobody answered any level twice"), std::string::npos)
      << outcome.err;
}

constexpr char kOnePerson[] =
    "intensity,num_yes,num_trials\n4,1,30\n6,4,30\n8,14,30\n11,25,30\n16,28,30\n";

TEST_F(FitGroupRobustTest, APosteriorHasAPriorOfItsLapseRate) {
  table("a.csv", kOnePerson);
  const std::vector<std::string> weber = {"weber", "--csv",  "a.csv", "--reference",
                                          "8",     "--free", "lapse", "--posterior"};
  const auto with = [](std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  };
  const auto plain = document(fit(weber).out)["posterior"];
  EXPECT_FALSE(plain.contains("prior_sensitivity"));
  auto same = document(fit(with(weber, {"--lapse-prior", "1,10"})).out)["posterior"];
  ASSERT_EQ(same["prior_sensitivity"].size(), 3U);
  EXPECT_GT(same["prior_sensitivity"][0]["lapse_rate"],
            same["prior_sensitivity"][2]["lapse_rate"]);
  same.erase("prior_sensitivity");
  EXPECT_EQ(same, plain);
  const std::string text = fit(with(weber, {"--lapse-prior", "2,50"}), /*as_json=*/false).out;
  EXPECT_NE(text.find("lapse rate Beta(2, 50)"), std::string::npos) << text;
  EXPECT_NE(text.find("at twice its weight: Weber fraction"), std::string::npos) << text;
  const std::vector<std::string> curve = {"psychometric", "--csv",   "a.csv", "--task",
                                          "yes-no",       "--lapse", "free"};
  const auto of_curve =
      document(fit(with(curve, {"--posterior", "--lapse-prior", "1,30"})).out)["fits"][0];
  EXPECT_EQ(of_curve["pse_posterior"]["medians_by_prior_weight"].size(), 3U);
  EXPECT_EQ(of_curve["posterior"]["prior_weights"], nlohmann::json::array({0.0, 0.5, 2.0}));
  for (const auto& wrong :
       {with(curve, {"--lapse-prior", "1,30"}),
        with(curve, {"--posterior", "--lapse-prior", "1"}),
        std::vector<std::string>{"weber", "--csv", "a.csv", "--reference", "8", "--posterior",
                                 "--lapse-prior", "1,20"}}) {
    const ProgramOutcome outcome = fit(wrong);
    EXPECT_EQ(outcome.exit_code, 2);
    EXPECT_NE(outcome.err.find("--lapse-prior"), std::string::npos) << outcome.err;
  }
}

}  // namespace fit_group_robust_test
}  // namespace jnd::app
