#include "analysis/mixed/people_lines.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <random>

#include "core/error.h"
#include "support/reference_data.h"

namespace jnd::analysis {
namespace people_lines_test {

/// Returns rows of people with x = -1, 0 and 1. There, the intercept of a person's line has 1/3
/// and the slope 1/2 of the residual variance, without a covariance. The scatter about a line
/// is a contrast of second order, `bend` times (1, -2, 1), whose square is 6 bend^2 with one
/// degree of freedom.
std::vector<PersonPoint> balanced(const std::vector<Line>& lines,
                                  const std::vector<double>& bends) {
  std::vector<PersonPoint> rows;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (const double x : {-1.0, 0.0, 1.0}) {
      rows.push_back(
          {i, x, lines[i].intercept + lines[i].slope * x + bends[i] * (x == 0.0 ? -2.0 : 1.0)});
    }
  }
  return rows;
}

const std::vector<Line> kLines = {{1.0, 0.4}, {2.0, 1.1}, {3.0, 0.6}, {6.0, 0.9}};
const std::vector<double> kBends = {0.1, -0.2, 0.05, 0.15};

TEST(PeopleLines, OfABalancedDesignAreThoseWorkedByHand) {
  const PeopleLines fit = fit_people_lines(balanced(kLines, kBends), 4);
  ASSERT_EQ(fit.status, FitStatus::kOk) << fit.reason;
  // The residual variance is 6 (0.01 + 0.04 + 0.0025 + 0.0225) / 4 = 0.1125.
  EXPECT_NEAR(fit.residual_sd, std::sqrt(0.1125), 1e-6);
  // The group has the means of the lines. The variances, with n - 1, are 14/3 and 0.29/3, and
  // the covariance is 0.8/3.
  EXPECT_NEAR(fit.group.intercept, 3.0, 1e-9);
  EXPECT_NEAR(fit.group.slope, 0.75, 1e-9);
  EXPECT_NEAR(fit.intercept_standard_error, std::sqrt(14.0 / 3.0 / 4.0), 1e-6);
  EXPECT_NEAR(fit.slope_standard_error, std::sqrt(0.29 / 3.0 / 4.0), 1e-6);
  const double between_intercepts = 14.0 / 3.0 - 0.1125 / 3.0;
  const double between_slopes = 0.29 / 3.0 - 0.1125 / 2.0;
  EXPECT_NEAR(fit.intercept_sd, std::sqrt(between_intercepts), 1e-6);
  EXPECT_NEAR(fit.slope_sd, std::sqrt(between_slopes), 1e-6);
  EXPECT_NEAR(*fit.correlation, 0.8 / 3.0 / std::sqrt(between_intercepts * between_slopes),
              1e-5);
}

TEST(PeopleLines, AreShrunkTowardTheGroupAsBayesRuleSays) {
  const PeopleLines fit = fit_people_lines(balanced(kLines, kBends), 4);
  ASSERT_EQ(fit.status, FitStatus::kOk);
  // A person's deviation from the group is G (G + residual)^-1 times that of the own line. G +
  // residual is the covariance of the own lines: [14/3, 0.8/3; 0.8/3, 0.29/3].
  const double g11 = 14.0 / 3.0 - 0.1125 / 3.0, g12 = 0.8 / 3.0,
               g22 = 0.29 / 3.0 - 0.1125 / 2.0;
  const double s11 = 14.0 / 3.0, s12 = 0.8 / 3.0, s22 = 0.29 / 3.0;
  const double det = s11 * s22 - s12 * s12;
  for (std::size_t i = 0; i < 4; ++i) {
    ASSERT_TRUE(fit.own[i]);
    EXPECT_NEAR(fit.own[i]->intercept, kLines[i].intercept, 1e-9);
    EXPECT_NEAR(fit.own[i]->slope, kLines[i].slope, 1e-9);
    const double u = kLines[i].intercept - 3.0, v = kLines[i].slope - 0.75;
    const double first = (s22 * u - s12 * v) / det, second = (s11 * v - s12 * u) / det;
    EXPECT_NEAR(fit.people[i].intercept, 3.0 + g11 * first + g12 * second, 1e-5);
    EXPECT_NEAR(fit.people[i].slope, 0.75 + g12 * first + g22 * second, 1e-5);
  }
}

TEST(PeopleLines, MoveAndStretchWithTheirUnits) {
  std::vector<PersonPoint> rows = balanced(kLines, kBends);
  rows.pop_back();  // The data are unbalanced, so that no two values agree by symmetry.
  const PeopleLines plain = fit_people_lines(rows, 4);
  for (PersonPoint& row : rows) {
    row.x = 100.0 * row.x + 7.0;
    row.y = 3.0 * row.y - 50.0;
  }
  const PeopleLines moved = fit_people_lines(rows, 4);
  ASSERT_EQ(plain.status, FitStatus::kOk);
  ASSERT_EQ(moved.status, FitStatus::kOk);
  EXPECT_NEAR(moved.group.slope, 0.03 * plain.group.slope, 1e-7);
  EXPECT_NEAR(moved.slope_sd, 0.03 * plain.slope_sd, 1e-7);
  EXPECT_NEAR(moved.residual_sd, 3.0 * plain.residual_sd, 1e-5);
  EXPECT_NEAR(moved.group.intercept + 7.0 * moved.group.slope,
              3.0 * plain.group.intercept - 50.0, 1e-5);
}

TEST(PeopleLines, ProfilesFarFromTheRowsAreThoseOfTheSlope) {
  std::vector<PersonPoint> rows = balanced(kLines, kBends);
  rows.pop_back();
  const Interval slope = people_lines_profile(rows, 4, LineParameter::kSlope);
  ASSERT_TRUE(slope.low && slope.high);
  for (PersonPoint& row : rows) row.x = 10.0 * (row.x + 1000.0);
  const Interval stretched = people_lines_profile(rows, 4, LineParameter::kSlope);
  EXPECT_NEAR(*stretched.low, 0.1 * *slope.low, 1e-7);
  EXPECT_NEAR(*stretched.high, 0.1 * *slope.high, 1e-7);
  // The rows lie a thousand units from x = 0. There, the height of a line differs from its
  // height at the rows by a thousand slopes.
  const Interval intercept = people_lines_profile(rows, 4, LineParameter::kIntercept);
  EXPECT_NEAR(*intercept.high - *intercept.low, 1000.0 * (*slope.high - *slope.low),
              10.0 * (*slope.high - *slope.low));
}

TEST(PeopleLines, SpreadsThatTheRowsDoNotShowAreAtTheirBound) {
  // The own slopes differ less than their standard error, and not together with the intercepts.
  const PeopleLines fit = fit_people_lines(
      balanced({{1.0, 0.51}, {2.0, 0.51}, {3.0, 0.47}, {6.0, 0.51}}, {0.2, -0.2, 0.3, -0.1}),
      4);
  ASSERT_EQ(fit.status, FitStatus::kOk);
  EXPECT_EQ(fit.slope_sd, 0.0);
  EXPECT_FALSE(fit.correlation);
  for (const Line& person : fit.people) EXPECT_NEAR(person.slope, fit.group.slope, 1e-4);
  // The lines then are parallel, and the differences of slopes are residual: 6 (0.04 + 0.04 +
  // 0.09 + 0.01) from the bends and 2 (0.01^2 3 + 0.03^2) from the slopes, with 4 + 3 degrees
  // of freedom.
  EXPECT_NEAR(fit.residual_sd, std::sqrt((6.0 * 0.18 + 2.0 * 0.0012) / 7.0), 1e-5);
  EXPECT_NEAR(fit.slope_standard_error, fit.residual_sd / std::sqrt(8.0), 1e-5);
}

TEST(PeopleLines, ProfileOfManyPeopleIsNearlyThatOfTheMean) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<Line> lines;
  std::vector<double> bends;
  for (int i = 0; i < 60; ++i) {
    lines.push_back({normal(random), 1.0 + 0.3 * normal(random)});
    bends.push_back(0.1 * normal(random));
  }
  const std::vector<PersonPoint> rows = balanced(lines, bends);
  const PeopleLines fit = fit_people_lines(rows, 60);
  const Interval profile = people_lines_profile(rows, 60, LineParameter::kSlope);
  ASSERT_TRUE(profile.low && profile.high);
  // For a mean of 60 own slopes, -2 ln L rises by about 60 ln(1 + t^2 / 59), which is nearly
  // symmetric.
  const double t = std::sqrt(59.0 * (std::exp(3.841459 / 60.0) - 1.0));
  EXPECT_NEAR(*profile.high - fit.group.slope, t * fit.slope_standard_error,
              0.03 * t * fit.slope_standard_error);
  EXPECT_NEAR(fit.group.slope - *profile.low, t * fit.slope_standard_error,
              0.03 * t * fit.slope_standard_error);
}

TEST(PeopleLines, AreNoneWhereNothingTellsTheSpread) {
  const auto reason = [](const std::vector<PersonPoint>& rows, std::size_t num_people) {
    const PeopleLines fit = fit_people_lines(rows, num_people);
    EXPECT_EQ(fit.status, FitStatus::kDegenerate);
    return fit.reason;
  };
  EXPECT_NE(reason(balanced({{1.0, 1.0}, {2.0, 2.0}}, {0.1, 0.1}), 2).find("at least 3"),
            std::string::npos);
  EXPECT_NE(reason(balanced(kLines, {0.0, 0.0, 0.0, 0.0}), 4).find("law of their own"),
            std::string::npos);
  std::vector<PersonPoint> pairs;
  for (std::size_t i = 0; i < 5; ++i) {
    pairs.push_back({i, 0.0, 0.1 * static_cast<double>(i * i)});
    pairs.push_back({i, 1.0, 1.0});
  }
  EXPECT_NE(reason(pairs, 5).find("more than two rows"), std::string::npos);
  EXPECT_NE(reason({{0, 1.0, 2.0}, {1, 1.0, 3.0}, {2, 1.0, 4.0}}, 3).find("two different"),
            std::string::npos);
  EXPECT_THROW((void)fit_people_lines({{0, std::nan(""), 1.0}}, 1), core::Error);
  EXPECT_THROW((void)fit_people_lines({{3, 1.0, 1.0}}, 1), core::Error);
}

TEST(PeopleLines, AreThoseOfLme4) {
  // The reference is from data/reference/mixed/people_lines.R. The data set sleepstudy is
  // lme4's own (Belenky et al. 2003), and its lmer(Reaction ~ Days + (Days | Subject)) is
  // published: 251.41, 10.47, 24.74, 5.92, 0.07.
  const auto& sets = test_support::reference_data("mixed/people_lines.json")["sets"];
  for (const auto& set : sets) {
    const std::string name = set.at("name");
    std::vector<PersonPoint> rows;
    for (std::size_t i = 0; i < set.at("x").size(); ++i) {
      rows.push_back({set.at("person")[i], set.at("x")[i], set.at("y")[i]});
    }
    const std::size_t num_people = set.at("people").size();
    const PeopleLines fit = fit_people_lines(rows, num_people);
    ASSERT_EQ(fit.status, FitStatus::kOk) << name << fit.reason;
    const auto expect = [&](double ours, const char* key) {
      const double theirs = set.at(key);
      EXPECT_NEAR(ours, theirs, 1e-4 * std::max(1.0, std::fabs(theirs))) << name << " " << key;
    };
    expect(fit.group.intercept, "intercept");
    expect(fit.group.slope, "slope");
    expect(fit.intercept_standard_error, "intercept_standard_error");
    expect(fit.slope_standard_error, "slope_standard_error");
    expect(fit.intercept_sd, "intercept_sd");
    expect(fit.slope_sd, "slope_sd");
    expect(fit.residual_sd, "residual_sd");
    expect(fit.log_likelihood, "log_likelihood");
    if (!set.at("correlation").is_null()) expect(fit.correlation.value(), "correlation");
    for (std::size_t i = 0; i < num_people; ++i) {
      EXPECT_NEAR(fit.people[i].intercept, set["people"][i]["intercept"].get<double>(), 5e-3)
          << name;
      EXPECT_NEAR(fit.people[i].slope, set["people"][i]["slope"].get<double>(), 1e-3) << name;
    }
    const Interval slope = people_lines_profile(rows, num_people, LineParameter::kSlope);
    const Interval intercept =
        people_lines_profile(rows, num_people, LineParameter::kIntercept);
    expect(slope.low.value(), "slope_profile_low");
    expect(slope.high.value(), "slope_profile_high");
    expect(intercept.low.value(), "intercept_profile_low");
    expect(intercept.high.value(), "intercept_profile_high");
  }
  EXPECT_GE(sets.size(), 4U);
}

}  // namespace people_lines_test
}  // namespace jnd::analysis
