#include "analysis/mixed/mixed_likelihood.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::analysis {
namespace mixed_likelihood_test {

/// Returns a model with one row for each group, and an intercept that differs between groups.
MixedModel intercepts(MixedLink link, const std::vector<double>& yes,
                      const std::vector<double>& trials) {
  const auto rows = static_cast<Eigen::Index>(yes.size());
  MixedModel model{.curve = {.link = link},
                   .x = RowMatrix::Ones(rows, 1),
                   .num_yes = yes,
                   .num_trials = trials,
                   .log_coefficients = log_coefficients_of(yes, trials),
                   .groupings = {}};
  MixedGrouping grouping{.name = "g",
                         .z = RowMatrix::Ones(rows, 1),
                         .group = {},
                         .num_groups = yes.size(),
                         .term_sizes = {1}};
  for (std::uint32_t i = 0; i < yes.size(); ++i) grouping.group.push_back(i);
  model.groupings = {grouping};
  return model;
}

Eigen::VectorXd at(std::initializer_list<double> values) {
  Eigen::VectorXd vector(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), vector.begin());
  return vector;
}

// With five of ten at eta = 0, the mode is 0 whatever theta is. The information of eta is 10 /
// 4 for the logit, and 10 phi(0)^2 / (1 / 4) = 20 / pi for the probit.
TEST(MixedLikelihoods, LaplaceByHandWhereTheModeIsZero) {
  const double answers = 10.0 * std::log(0.5) + std::log(252.0);
  for (const double theta : {0.0, 0.5, 2.0}) {
    const MixedModel logit = intercepts(MixedLink::kLogit, {5.0}, {10.0});
    EXPECT_NEAR(*MixedLikelihood(logit, 1).value(at({0.0, theta})),
                answers - 0.5 * std::log1p(2.5 * theta * theta), 1e-12);
    const MixedModel probit = intercepts(MixedLink::kProbit, {5.0}, {10.0});
    EXPECT_NEAR(*MixedLikelihood(probit, 1).value(at({0.0, theta})),
                answers - 0.5 * std::log1p(20.0 / std::numbers::pi * theta * theta), 1e-12);
  }
}

/// Returns ln of the integral over u of the answers' probability. The steps are even, and their
/// error falls faster than any power of their size.
double integrated(const MixedCurve& curve, double yes, double trials, double beta,
                  double theta) {
  constexpr double kStep = 0.01;
  double sum = 0.0;
  for (double u = -10.0; u <= 10.0; u += kStep) {
    const double p = curve_probability(curve, beta + theta * u);
    sum += kStep * std::exp(-0.5 * u * u) / std::sqrt(2.0 * std::numbers::pi) *
           std::pow(p, yes) * std::pow(1.0 - p, trials - yes);
  }
  return std::log(sum);
}

TEST(MixedLikelihoods, QuadratureIsTheIntegral) {
  const std::vector<double> yes = {3.0, 8.0, 0.0, 12.0}, trials = {10.0, 10.0, 7.0, 12.0};
  for (const MixedCurve& curve :
       {MixedCurve{MixedLink::kProbit}, MixedCurve{MixedLink::kLogit},
        MixedCurve{MixedLink::kCloglog}, MixedCurve{MixedLink::kProbit, 0.25, 0.02}}) {
    MixedModel model = intercepts(curve.link, yes, trials);
    model.curve = curve;
    double expected = model.log_coefficients;
    for (std::size_t i = 0; i < yes.size(); ++i) {
      expected += integrated(curve, yes[i], trials[i], 0.3, 0.8);
    }
    EXPECT_NEAR(*MixedLikelihood(model, 31).value(at({0.3, 0.8})), expected, 1e-6)
        << to_string(curve.link);
    EXPECT_NEAR(*MixedLikelihood(model, 1).value(at({0.3, 0.8})), expected, 0.3);
  }
}

TEST(MixedLikelihoods, WithoutSpreadIsThatOfTheFixedEffectsAlone) {
  const std::vector<double> yes = {3.0, 8.0}, trials = {10.0, 10.0};
  const MixedModel model = intercepts(MixedLink::kLogit, yes, trials);
  const double p = 1.0 / (1.0 + std::exp(-0.3));
  const double expected =
      std::log(120.0) + std::log(45.0) + 11.0 * std::log(p) + 9.0 * std::log(1.0 - p);
  for (const int nodes : {1, 7}) {
    MixedLikelihood likelihood(model, nodes);
    EXPECT_NEAR(*likelihood.value(at({0.3, 0.0})), expected, 1e-12);
    EXPECT_NEAR(*likelihood.value(at({0.3, 1e-7})), expected, 1e-10);
  }
}

/// Returns random rows of six people by four items, with correlated and uncorrelated effects.
MixedModel people_and_items(const MixedCurve& curve, bool with_items) {
  core::RandomStream stream(5, "rows");
  constexpr int kRows = 120;
  MixedModel model{.curve = curve, .x = RowMatrix(kRows, 2), .groupings = {}};
  MixedGrouping people{
      .name = "p", .z = RowMatrix(kRows, 2), .group = {}, .num_groups = 6, .term_sizes = {2}};
  MixedGrouping items{.name = "i",
                      .z = RowMatrix(kRows, 2),
                      .group = {},
                      .num_groups = 4,
                      .term_sizes = {1, 1}};
  for (int i = 0; i < kRows; ++i) {
    const double u = std::round(2.0 * stream.normal()) / 2.0;
    model.x.row(i) << 1.0, u;
    people.z.row(i) << 1.0, u;
    items.z.row(i) << 1.0, u * u;
    people.group.push_back(static_cast<std::uint32_t>(i / 20));
    items.group.push_back(static_cast<std::uint32_t>(stream.below(4)));
    model.num_trials.push_back(1.0 + static_cast<double>(stream.below(3)));
    double yes = 0.0;
    for (int k = 0; k < model.num_trials.back(); ++k) {
      yes += stream.with_probability(curve_probability(curve, u + 0.3 * (i / 20 - 3)));
    }
    model.num_yes.push_back(yes);
  }
  model.groupings = {people};
  if (with_items) model.groupings.push_back(items);
  return model;
}

TEST(MixedLikelihoods, GradientIsThatOfTheValue) {
  for (const MixedLink link : {MixedLink::kProbit, MixedLink::kLogit, MixedLink::kCloglog}) {
    for (const auto& [nodes, with_items] : {std::pair{1, true}, {1, false}, {5, false}}) {
      for (const double guess : {0.0, 0.5}) {
        const MixedModel model = people_and_items({link, guess, 0.04 * guess}, with_items);
        MixedLikelihood likelihood(model, nodes);
        core::RandomStream stream(6, "parameters");
        Eigen::VectorXd parameters(model.num_parameters()), gradient;
        for (double& one : parameters) one = stream.uniform(0.3, 0.7);
        ASSERT_TRUE(likelihood.value(parameters, gradient));
        constexpr double kStep = 1e-4;
        for (Eigen::Index i = 0; i < parameters.size(); ++i) {
          Eigen::VectorXd moved = parameters;
          moved[i] += kStep;
          const double above = *likelihood.value(moved);
          moved[i] -= 2.0 * kStep;
          const double below = *likelihood.value(moved);
          EXPECT_NEAR(gradient[i], (above - below) / (2.0 * kStep), 2e-5)
              << to_string(link) << " nodes " << nodes << " parameter " << i;
        }
      }
    }
  }
}

TEST(MixedLikelihoods, WhichGroupingIsFirstDoesNotMatter) {
  const MixedModel model = people_and_items({MixedLink::kProbit}, true);
  MixedModel turned = model;
  std::swap(turned.groupings[0], turned.groupings[1]);
  const Eigen::VectorXd parameters = at({0.1, 0.9, 0.5, 0.2, 0.3, 0.4, 0.25});
  const Eigen::VectorXd turned_parameters = at({0.1, 0.9, 0.4, 0.25, 0.5, 0.2, 0.3});
  EXPECT_NEAR(*MixedLikelihood(model, 1).value(parameters),
              *MixedLikelihood(turned, 1).value(turned_parameters), 1e-10);
}

TEST(MixedLikelihoods, RowsAddedUpHaveTheSame) {
  for (const bool with_items : {true, false}) {
    const MixedModel model = people_and_items({MixedLink::kLogit}, with_items);
    const MixedModel fewer = collapsed(model);
    EXPECT_LT(fewer.num_rows(), model.num_rows());
    Eigen::VectorXd parameters = Eigen::VectorXd::Constant(model.num_parameters(), 0.4);
    EXPECT_NEAR(*MixedLikelihood(model, 1).value(parameters),
                *MixedLikelihood(fewer, 1).value(parameters), 1e-10);
  }
}

TEST(MixedLikelihoods, SeveralNodesNeedOneGrouping) {
  const MixedModel model = people_and_items({MixedLink::kLogit}, true);
  EXPECT_THROW(MixedLikelihood(model, 5), core::Error);
  const MixedModel alone = people_and_items({MixedLink::kLogit}, false);
  EXPECT_NO_THROW(MixedLikelihood(alone, 61));
}

}  // namespace mixed_likelihood_test
}  // namespace jnd::analysis
