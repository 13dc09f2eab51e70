#include "analysis/mixed/mixed_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "analysis/mixed/mixed_table.h"
#include "core/error.h"

namespace jnd::analysis {
namespace mixed_fit_test {

MixedData data_of(const std::string& table_text, const std::string& fixed,
                  const std::string& random, Contrasts contrasts = Contrasts::kTreatment) {
  const MixedFormulas formulas{parse_formula(fixed), parse_random_terms(random)};
  const TrialTable table =
      parse_trial_table(table_text, "t.csv",
                        {.answers = {.yes = "k", .yes_value = {}, .trials = "n"},
                         .variables = columns_of(formulas),
                         .where = {}});
  return mixed_data(formulas, Design(formulas.fixed, table, contrasts), table, contrasts);
}

/// Returns answers of three people at five levels of two conditions.
std::string three_people(double unit = 1.0) {
  std::string text = "p,c,u,k,n\n";
  const int yes[3][2][5] = {{{1, 3, 8, 15, 19}, {2, 6, 12, 18, 20}},
                            {{0, 4, 11, 17, 20}, {3, 8, 15, 18, 20}},
                            {{2, 3, 6, 11, 16}, {1, 5, 9, 14, 19}}};
  for (int p = 0; p < 3; ++p) {
    for (int c = 0; c < 2; ++c) {
      for (int i = 0; i < 5; ++i) {
        text += "P" + std::to_string(p) + (c == 0 ? ",A," : ",B,") +
                std::to_string(unit * (i - 2)) + "," + std::to_string(yes[p][c][i]) + ",20\n";
      }
    }
  }
  return text;
}

// Four groups have six of ten each. They differ less than by chance, so there is no spread.
TEST(MixedFits, WithoutSpreadIsThatOfTheFixedEffectsAlone) {
  const MixedFit fit =
      fit_mixed(data_of("g,k,n\na,6,10\nb,6,10\nc,6,10\nd,6,10\n", "1", "1 | g"),
                {.curve = {.link = MixedLink::kLogit}});
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  EXPECT_EQ(fit.fixed[0].name, "(Intercept)");
  EXPECT_NEAR(fit.fixed[0].estimate, std::log(1.5), 1e-6);
  EXPECT_NEAR(fit.fixed[0].standard_error, 1.0 / std::sqrt(40.0 * 0.24), 1e-5);
  EXPECT_NEAR(fit.random[0].sd, 0.0, 1e-3);
  EXPECT_NEAR(fit.log_likelihood,
              24.0 * std::log(0.6) + 16.0 * std::log(0.4) + 4.0 * std::log(210.0), 1e-6);
  EXPECT_NEAR(fit.aic, 4.0 - 2.0 * fit.log_likelihood, 1e-12);
  ASSERT_FALSE(fit.notes.empty());
  EXPECT_NE(fit.notes[0].find("bound 0"), std::string::npos);
}

TEST(MixedFits, UnitsDoNotMatter) {
  const MixedOptions options = {.curve = {.link = MixedLink::kProbit}};
  const MixedFit one = fit_mixed(data_of(three_people(), "u * c", "1 + u | p"), options);
  const MixedFit other =
      fit_mixed(data_of(three_people(1000.0), "u * c", "1 + u | p"), options);
  ASSERT_EQ(one.status, FitStatus::kOk) << one.reason;
  ASSERT_EQ(other.status, FitStatus::kOk) << other.reason;
  EXPECT_NEAR(one.log_likelihood, other.log_likelihood, 1e-8);
  EXPECT_NEAR(one.fixed[1].estimate, 1000.0 * other.fixed[1].estimate, 1e-6);
  EXPECT_NEAR(one.fixed[1].standard_error, 1000.0 * other.fixed[1].standard_error, 1e-5);
  EXPECT_NEAR(one.random[1].sd, 1000.0 * other.random[1].sd, 1e-4);
  EXPECT_EQ(one.random[1].correlations.size(), 1U);
}

TEST(MixedFits, ContrastsSayTheSameInOtherWords) {
  const MixedFit treatment = fit_mixed(data_of(three_people(), "c + u", "1 | p"));
  const MixedFit sum = fit_mixed(data_of(three_people(), "c + u", "1 | p", Contrasts::kSum));
  ASSERT_EQ(treatment.status, FitStatus::kOk);
  EXPECT_NEAR(treatment.log_likelihood, sum.log_likelihood, 1e-9);
  EXPECT_EQ(treatment.fixed[1].name, "cB");
  EXPECT_EQ(sum.fixed[1].name, "c1");
  // c1 is A minus the mean of both, and cB is B minus A.
  EXPECT_NEAR(sum.fixed[1].estimate, -0.5 * treatment.fixed[1].estimate, 1e-6);
  EXPECT_NEAR(sum.fixed[0].estimate,
              treatment.fixed[0].estimate + 0.5 * treatment.fixed[1].estimate, 1e-6);
}

TEST(MixedFits, UncorrelatedEffectsAreTermsOfTheirOwn) {
  const MixedData data = data_of(three_people(), "u", "1 + u || p");
  ASSERT_EQ(data.terms.size(), 2U);
  EXPECT_EQ(data.terms[1].names, (std::vector<std::string>{"u"}));
  const MixedFit fit = fit_mixed(data);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  ASSERT_EQ(fit.random.size(), 2U);
  EXPECT_TRUE(fit.random[1].correlations.empty());
  EXPECT_EQ(fit.num_parameters, 4);
}

TEST(MixedFits, SeveralNodesAreNearerToTheIntegral) {
  const MixedData data = data_of(three_people(), "u", "1 + u | p");
  const MixedFit nine = fit_mixed(data, {.num_nodes = 9});
  const MixedFit thirteen = fit_mixed(data, {.num_nodes = 13});
  ASSERT_EQ(nine.status, FitStatus::kOk) << nine.reason;
  EXPECT_NEAR(nine.log_likelihood, thirteen.log_likelihood, 1e-5);
}

TEST(MixedFits, SeparatedAnswersHaveNone) {
  const MixedFit fit =
      fit_mixed(data_of("p,u,k,n\na,1,0,9\na,2,9,9\nb,1,0,9\nb,2,9,9\n", "u", "1 | p"));
  EXPECT_EQ(fit.status, FitStatus::kDegenerate);
  EXPECT_NE(fit.reason.find("separated"), std::string::npos) << fit.reason;
  EXPECT_TRUE(fit.fixed.empty());
}

TEST(MixedFits, RefusesColumnsAndGroupsThatSayNothing) {
  const std::string table = "p,u,v,k,n\na,1,2,3,9\na,2,4,5,9\nb,1,2,4,9\nb,3,6,8,9\n";
  try {
    static_cast<void>(fit_mixed(data_of(table, "u + v", "1 | p")));
    FAIL() << "v is twice u";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("found v"), std::string::npos) << error.what();
  }
  EXPECT_THROW(static_cast<void>(
                   fit_mixed(data_of("p,u,k,n\na,1,3,9\na,2,4,9\na,3,7,9\n", "u", "1 | p"))),
               core::Error);
}

/// In nearly a quarter of the redraws from this fit (23.8 % by R), one step between two levels
/// divides everybody's answers. No slope is then the most likely one, wherever a search stops.
TEST(MixedFits, RedrawnAnswersThatAreSeparatedHaveNoFit) {
  const std::string text =
      "p,u,k,n\np1,1,0,3\np1,2,1,3\np1,3,3,3\np1,4,3,3\np2,1,0,3\np2,2,0,3\np2,3,2,3\n"
      "p2,4,3,3\np3,1,0,3\np3,2,1,3\np3,3,2,3\np3,4,3,3\n";
  const MixedRefit refit(data_of(text, "u", "1 | p"), {});
  ASSERT_EQ(refit.fit().status, FitStatus::kOk) << refit.fit().reason;
  int num_without = 0;
  for (int index = 0; index < 200; ++index) {
    if (refit.redrawn(1, index).size() == 0) ++num_without;
  }
  // Three standard deviations of a binomial count are 18.
  EXPECT_NEAR(num_without, 0.238 * 200, 18);
}

TEST(MixedFits, RedrawnAnswersDependOnTheSeedAlone) {
  const MixedRefit refit(data_of(three_people(), "u * c", "1 + u | p"), {});
  ASSERT_EQ(refit.fit().status, FitStatus::kOk);
  const Eigen::VectorXd one = refit.redrawn(3, 5), again = refit.redrawn(3, 5);
  ASSERT_EQ(one.size(), 4);
  EXPECT_EQ(one, again);
  EXPECT_NE(one, refit.redrawn(3, 6));
  EXPECT_NE(one, refit.redrawn(4, 5));
}

/// The slopes of redrawn answers scatter about the fitted slope as its standard error says.
TEST(MixedFits, RedrawnAnswersScatterAsTheStandardErrorSays) {
  const MixedRefit refit(data_of(three_people(), "u + c", "1 | p"), {});
  double sum = 0.0, squares = 0.0;
  constexpr int kDraws = 200;
  for (int i = 0; i < kDraws; ++i) {
    const Eigen::VectorXd one = refit.redrawn(1, i);
    ASSERT_EQ(one.size(), 3);
    sum += one[1];
    squares += one[1] * one[1];
  }
  const double mean = sum / kDraws, sd = std::sqrt(squares / kDraws - mean * mean);
  const FixedEffect& slope = refit.fit().fixed[1];
  EXPECT_NEAR(mean, slope.estimate, 0.5 * slope.standard_error);
  EXPECT_NEAR(sd / slope.standard_error, 1.0, 0.25);
}

}  // namespace mixed_fit_test
}  // namespace jnd::analysis
