#include "analysis/mixed/mixed_derived.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace jnd::analysis {
namespace mixed_derived_test {

constexpr double kQ75 = 0.6744897501960817;  ///< This is Phi^-1(0.75).

TrialTable rows() {
  return parse_trial_table("u,c,w,y\n1,A,3,0\n2,A,5,1\n4,B,3,0\n8,B,5,1\n", "t.csv",
                           {.answers = {.yes = "y", .yes_value = {}, .trials = {}},
                            .variables = {"u", "c", "w"},
                            .where = {}});
}

StimulusLines lines_of(const std::string& text, Contrasts contrasts = Contrasts::kTreatment) {
  const Formula formula = parse_formula(text);
  const TrialTable table = rows();
  return stimulus_lines(formula, Design(formula, table, contrasts), table, "u");
}

Eigen::VectorXd vector(std::initializer_list<double> values) {
  Eigen::VectorXd made(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), made.begin());
  return made;
}

const DerivedQuantity& named(const std::vector<DerivedQuantity>& all, const std::string& name) {
  for (const DerivedQuantity& one : all) {
    if (one.name == name) return one;
  }
  throw std::runtime_error("no " + name);
}

/// Many groups, so that Student's t is the normal distribution.
MixedUncertainty uncertain(const Eigen::MatrixXd& covariance) {
  return {.covariance = covariance, .num_groups = 1000000, .redrawn = {}};
}
MixedUncertainty sure(Eigen::Index num) { return uncertain(Eigen::MatrixXd::Zero(num, num)); }

// In A, eta = -6 + 2 u. In B, eta = (-6 + 1) + (2 + 0.5) u.
TEST(MixedDerived, OfALineByHand) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(4, 4);
  covariance(0, 0) = 0.04;
  covariance(1, 1) = 0.01;
  const auto found = derived_quantities(lines_of("u * c"), MixedLink::kProbit, 0.75,
                                        vector({-6.0, 2.0, 1.0, 0.5}), uncertain(covariance));
  ASSERT_EQ(found.size(), 9U);
  const DerivedQuantity& pse = named(found, "PSE, c A");
  EXPECT_NEAR(*pse.value, 3.0, 1e-12);
  // The variance is (var a + PSE^2 var b) / b^2.
  EXPECT_NEAR(*pse.standard_error, std::sqrt((0.04 + 9.0 * 0.01) / 4.0), 1e-12);
  EXPECT_NEAR(*pse.ci95.high - *pse.value, 1.959963984540054 * *pse.standard_error, 1e-5);
  const DerivedQuantity& jnd = named(found, "JND, c A");
  EXPECT_NEAR(*jnd.value, kQ75 / 2.0, 1e-12);
  EXPECT_NEAR(*jnd.standard_error, kQ75 / 4.0 * 0.1, 1e-12);
  // The interval of ln JND, whose standard error is 0.05.
  EXPECT_NEAR(*jnd.ci95.low, kQ75 / 2.0 * std::exp(-1.959964 * 0.05), 1e-6);
  EXPECT_NEAR(*jnd.ci95.high, kQ75 / 2.0 * std::exp(1.959964 * 0.05), 1e-6);
  EXPECT_NEAR(*named(found, "PSE, c B").value, 2.0, 1e-12);
  EXPECT_NEAR(*named(found, "Weber fraction, c B").value, kQ75 / 2.5 / 2.0, 1e-12);
  EXPECT_NEAR(*named(found, "PSE, c B - c A").value, -1.0, 1e-12);
  EXPECT_NEAR(*named(found, "JND, c B - c A").value, kQ75 / 2.5 - kQ75 / 2.0, 1e-12);
}

TEST(MixedDerived, ContrastsAndUnitsOfScaleLeaveThemAsTheyAre) {
  // With sum contrasts, c1 is 1 for A and -1 for B.
  const auto found = derived_quantities(lines_of("u * c", Contrasts::kSum), MixedLink::kProbit,
                                        0.75, vector({-5.5, 2.25, -0.5, -0.25}), sure(4));
  EXPECT_NEAR(*named(found, "PSE, c A").value, 3.0, 1e-12);
  EXPECT_NEAR(*named(found, "PSE, c B").value, 2.0, 1e-12);
  // The mean of u is 3.75, so eta = 2 (u - 3.75).
  const auto centred = derived_quantities(lines_of("center(u)"), MixedLink::kLogit, 0.75,
                                          vector({0.0, 2.0}), sure(2));
  EXPECT_NEAR(*named(centred, "PSE").value, 3.75, 1e-12);
  EXPECT_NEAR(*named(centred, "JND").value, std::log(3.0) / 2.0, 1e-12);
}

// With eta = a + b ln u, the PSE is exp(-a / b) and the Weber fraction exp(q / b) - 1.
TEST(MixedDerived, OfALineOverTheLogarithm) {
  const StimulusLines lines = lines_of("log(u)");
  EXPECT_EQ(lines.axis, StimulusAxis::kLogarithmic);
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(2, 2);
  covariance(0, 0) = 0.09;
  const auto found = derived_quantities(lines, MixedLink::kProbit, 0.75, vector({-3.0, 2.0}),
                                        uncertain(covariance));
  EXPECT_NEAR(*named(found, "PSE").value, std::exp(1.5), 1e-12);
  EXPECT_NEAR(*named(found, "PSE").standard_error, std::exp(1.5) * 0.3 / 2.0, 1e-12);
  EXPECT_NEAR(*named(found, "Weber fraction").value, std::expm1(kQ75 / 2.0), 1e-12);
  EXPECT_NEAR(*named(found, "JND").value, std::exp(1.5) * std::expm1(kQ75 / 2.0), 1e-12);
  // The interval of ln PSE, whose standard error is 0.15.
  EXPECT_NEAR(*named(found, "PSE").ci95.low, std::exp(1.5 - 1.959964 * 0.15), 1e-5);
}

/// eta = 3 - 2 ln u has F = 1/2 at ln u = 1.5, and F = 0.75 at a smaller stimulus, which is
/// nearer than the one where F = 0.25.
TEST(MixedDerived, AFallingCurveOverTheLogarithmHasItsJndBelowThePse) {
  const std::vector<double> values =
      derived_values(lines_of("log(u)"), MixedLink::kProbit, 0.75, vector({3.0, -2.0}));
  EXPECT_NEAR(values[0], std::exp(1.5), 1e-12);
  EXPECT_NEAR(values[1], std::exp(1.5) - std::exp(1.5 - kQ75 / 2.0), 1e-12);
  EXPECT_NEAR(values[2], 1.0 - std::exp(-kQ75 / 2.0), 1e-12);
  // The step on the axis is kQ75 / 0.5, and ln step has a standard error of 0.5.
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(2, 2);
  covariance(1, 1) = 0.25 * 0.25;
  const auto found = derived_quantities(lines_of("log(u)"), MixedLink::kProbit, 0.75,
                                        vector({1.0, -0.5}), uncertain(covariance));
  const Interval weber = named(found, "Weber fraction").ci95;
  EXPECT_NEAR(*weber.low, 1.0 - std::exp(-kQ75 / 0.5 * std::exp(-1.959964 * 0.5)), 1e-6);
  EXPECT_NEAR(*weber.high, 1.0 - std::exp(-kQ75 / 0.5 * std::exp(1.959964 * 0.5)), 1e-6);
}

/// A slope of 2 with a standard error of 1, estimated from six people: t(5) is 2.5706.
TEST(MixedDerived, FewGroupsHaveTheIntervalOfStudentsT) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(2, 2);
  covariance(1, 1) = 1.0;
  const auto found =
      derived_quantities(lines_of("u"), MixedLink::kProbit, 0.75, vector({-6.0, 2.0}),
                         {.covariance = covariance, .num_groups = 6, .redrawn = {}});
  const DerivedQuantity& jnd = named(found, "JND");
  EXPECT_NEAR(*jnd.ci95.low, kQ75 / 2.0 * std::exp(-2.570582 * 0.5), 1e-6);
  EXPECT_NEAR(*jnd.ci95.high, kQ75 / 2.0 * std::exp(2.570582 * 0.5), 1e-6);
  const DerivedQuantity& pse = named(found, "PSE");
  EXPECT_NEAR(*pse.ci95.high, 3.0 + 2.570582 * 1.5, 1e-5);
}

TEST(MixedDerived, GradientsAreThoseOfTheValues) {
  for (const char* formula : {"u * c", "log(u) * c", "u * c + w"}) {
    const StimulusLines lines = lines_of(formula);
    const Eigen::Index num = lines.cells[0].offset.size();
    Eigen::VectorXd beta = vector({-5.0, 1.9, 0.7, 0.4, 0.1}).head(num);
    if (num == 5) beta = vector({-5.0, 1.9, 0.7, 0.1, 0.4});
    for (const double sign : {1.0, -1.0}) {
      beta *= sign;
      for (const MixedLink link : {MixedLink::kProbit, MixedLink::kCloglog}) {
        for (Eigen::Index i = 0; i < num; ++i) {
          Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(num, num);
          covariance(i, i) = 1.0;
          const auto found = derived_quantities(lines, link, 0.8, beta, uncertain(covariance));
          constexpr double kStep = 1e-5;
          Eigen::VectorXd moved = beta;
          moved[i] += kStep;
          const std::vector<double> above = derived_values(lines, link, 0.8, moved);
          moved[i] -= 2.0 * kStep;
          const std::vector<double> below = derived_values(lines, link, 0.8, moved);
          for (std::size_t k = 0; k < found.size(); ++k) {
            EXPECT_NEAR(*found[k].standard_error,
                        std::fabs(above[k] - below[k]) / (2.0 * kStep), 1e-6)
                << formula << " " << found[k].name << " " << i;
          }
        }
      }
    }
  }
}

TEST(MixedDerived, CloglogHasItsMiddleElsewhere) {
  const auto found =
      derived_quantities(lines_of("u"), MixedLink::kCloglog, 0.75, vector({0.0, 1.0}), sure(2));
  EXPECT_NEAR(*named(found, "PSE").value, std::log(std::log(2.0)), 1e-12);
  EXPECT_NEAR(*named(found, "JND").value, std::log(2.0), 1e-12);
  // The PSE is below 0, where a fraction has no meaning.
  EXPECT_FALSE(named(found, "Weber fraction").value);
}

TEST(MixedDerived, OtherCovariatesAreHeldAtTheirMeans) {
  const StimulusLines lines = lines_of("u + w");
  ASSERT_EQ(lines.held, (std::vector<std::string>{"w"}));
  // The mean of w is 4, so eta = -5 + 4 * 0.5 + u.
  EXPECT_NEAR(derived_values(lines, MixedLink::kProbit, 0.75, vector({-5.0, 1.0, 0.5}))[0], 3.0,
              1e-12);
}

TEST(MixedDerived, FallingCurvesHaveAPositiveJnd) {
  const std::vector<double> values =
      derived_values(lines_of("u"), MixedLink::kProbit, 0.75, vector({6.0, -2.0}));
  EXPECT_NEAR(values[0], 3.0, 1e-12);
  EXPECT_NEAR(values[1], kQ75 / 2.0, 1e-12);
}

TEST(MixedDerived, RefusesAStimulusThatIsNoLine) {
  EXPECT_THROW(lines_of("u + log(u)"), FormulaError);
  EXPECT_THROW(lines_of("exp(u)"), FormulaError);
  EXPECT_THROW(lines_of("factor(u)"), FormulaError);
  EXPECT_THROW(lines_of("c"), FormulaError);
}

/// Redraws of a line with slope 1, whose PSE is 0, 0.01 and so on to 2.
MixedUncertainty redrawn_places(std::size_t num_groups) {
  MixedUncertainty uncertainty = sure(2);
  uncertainty.num_groups = num_groups;
  for (int i = 0; i <= 200; ++i) uncertainty.redrawn.push_back(vector({-0.01 * i, 1.0}));
  return uncertainty;
}
Interval pse_interval(const MixedUncertainty& uncertainty) {
  return named(derived_quantities(lines_of("u"), MixedLink::kProbit, 0.75, vector({-1.0, 1.0}),
                                  uncertainty),
               "PSE")
      .bootstrap_ci95;
}

TEST(MixedDerived, BootstrapIntervalsAreQuantilesOfTheRedrawn) {
  const Interval many = pse_interval(redrawn_places(1000000));
  EXPECT_NEAR(*many.low, 0.05, 1e-5);
  EXPECT_NEAR(*many.high, 1.95, 1e-5);
  // For 13 groups the percentiles are 1.167 and 98.833 (Hesterberg 2015).
  const Interval few = pse_interval(redrawn_places(13));
  EXPECT_NEAR(*few.low, 2.0 * 0.01167, 1e-4);
  EXPECT_NEAR(*few.high, 2.0 - 2.0 * 0.01167, 1e-4);
}

/// Four of 205 redraws without a fit take the places of the four at either end.
TEST(MixedDerived, RedrawsWithoutAFitCountAsBeyondEitherEnd) {
  MixedUncertainty uncertainty = redrawn_places(1000000);
  uncertainty.redrawn.resize(205);
  const Interval some = pse_interval(uncertainty);
  EXPECT_NEAR(*some.low, 0.01 * (0.025 * 204 - 4.0), 1e-5);
  EXPECT_NEAR(*some.high, 2.0 - 0.01 * (0.025 * 204 - 4.0), 1e-5);
  uncertainty.redrawn.resize(210);
  const Interval more = pse_interval(uncertainty);
  EXPECT_FALSE(more.low || more.high);
}

TEST(MixedDerived, TooFewRedrawsOrGroupsHaveNoBootstrapInterval) {
  EXPECT_EQ(num_redraws_needed(4), std::nullopt);
  EXPECT_FALSE(pse_interval(redrawn_places(4)).low);
  // Of 6 groups the lower percentile is 0.243: Phi(-sqrt(6 / 5) 2.5706).
  EXPECT_EQ(num_redraws_needed(6), 412U);
  EXPECT_FALSE(pse_interval(redrawn_places(6)).low);
}

}  // namespace mixed_derived_test
}  // namespace jnd::analysis
