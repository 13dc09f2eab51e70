#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "analysis/hierarchical/hierarchical_level.h"
#include "analysis/hierarchical/hierarchical_model.h"
#include "core/psychometric_function.h"

namespace jnd::analysis {
namespace hierarchical_scatter_test {

/// Returns a structure whose parameters are a, p, the sd of a and the sd of p, and then r, tau
/// and v if it has them.
HierarchicalStructure structure_with(bool has_scatter, bool has_own_lapses, bool has_lapses) {
  HierarchicalStructure structure{.has_places = true,
                                  .has_lapses = has_lapses,
                                  .loadings = {{0, 0, 2}, {1, 1, 3}},
                                  .num_random_effects = 2,
                                  .has_own_lapses = has_own_lapses,
                                  .has_scatter = has_scatter};
  structure.num_parameters = 4 + static_cast<int>(has_scatter) +
                             static_cast<int>(has_own_lapses) + static_cast<int>(has_lapses);
  return structure;
}

Eigen::VectorXd vector_of(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(),
                                           static_cast<Eigen::Index>(values.size()));
}

/// Returns levels in ln(x / reference), with answers that lie on no curve.
HierarchicalPerson some_person(int more_yes = 0) {
  return {{.condition = 0,
           .log_ratio = {-0.8, -0.3, 0.1, 0.5, 0.9},
           .num_yes = {1.0, 2.0 + more_yes, 6.0, 8.0, 11.0},
           .num_no = {9.0, 8.0 - more_yes, 4.0, 2.0, 1.0},
           .order = {0.0, 0.0, 0.0, 0.0, 0.0}}};
}

/// Returns ln of the probability of k yes among n under a beta distribution with the mean p.
/// The test computes it by itself.
double log_beta_binomial(double k, double n, double p, double rho) {
  const double sum = 1.0 / rho - 1.0;
  const auto log_beta = [](double a, double b) {
    return std::lgamma(a) + std::lgamma(b) - std::lgamma(a + b);
  };
  return log_beta(k + sum * p, n - k + sum * (1.0 - p)) - log_beta(sum * p, sum * (1.0 - p));
}

/// Returns ln of the probability of a person's answers with the numbers a and p, without
/// binomial coefficients.
double log_answers(const HierarchicalPerson& person, double a, double p, double lapse,
                   double rho) {
  double sum = 0.0;
  for (std::size_t i = 0; i < person[0].log_ratio.size(); ++i) {
    const double z = std::exp(a) * (person[0].log_ratio[i] - p);
    const double yes = lapse + (1.0 - 2.0 * lapse) * core::standard_normal_cdf(z);
    const double k = person[0].num_yes[i], m = person[0].num_no[i];
    sum += rho > 0.0 ? log_beta_binomial(k, k + m, yes, rho)
                     : k * std::log(yes) + m * std::log(1.0 - yes);
  }
  return sum;
}

/// Returns the mean over a standard normal number, with steps far smaller than those of any
/// rule.
double normal_mean(const std::function<double(double)>& value) {
  constexpr double kStep = 0.02;
  double sum = 0.0;
  for (int i = -400; i <= 400; ++i) {
    const double x = kStep * i;
    sum += kStep * std::exp(-0.5 * x * x) * value(x);
  }
  return sum / std::sqrt(2.0 * 3.14159265358979323846);
}

TEST(HierarchicalScatter, WithoutScatterTheLikelihoodIsTheBinomialOneToTheBit) {
  const std::vector<HierarchicalPerson> people = {some_person(), some_person(2)};
  const HierarchicalLikelihood binomial(structure_with(false, false, true), people, 9);
  const HierarchicalLikelihood scattered(structure_with(true, false, true), people, 9);
  for (const double a : {0.4, 0.9}) {
    for (const double v : {0.0, 0.2}) {
      Eigen::VectorXd rise, rise_scattered;
      const double value = binomial(vector_of({a, 0.1, 0.3, 0.2, v}), &rise);
      EXPECT_EQ(scattered(vector_of({a, 0.1, 0.3, 0.2, 0.0, v}), &rise_scattered), value);
      EXPECT_EQ(rise_scattered(4), 0.0);
      for (const int at : {0, 1, 2, 3}) EXPECT_EQ(rise_scattered(at), rise(at));
      EXPECT_EQ(rise_scattered(5), rise(4));
    }
  }
}

TEST(HierarchicalScatter, TheLikelihoodIsSmoothDownToNoScatter) {
  const std::vector<HierarchicalPerson> people = {some_person()};
  const HierarchicalLikelihood likelihood(structure_with(true, false, false), people, 9);
  const auto at = [&](double r) { return likelihood(vector_of({0.7, 0.1, 0.3, 0.2, r})); };
  // The likelihood is even in r, so r contributes by its square.
  const double slope = (at(1e-3) - at(0.0)) / 1e-6;
  EXPECT_NEAR((at(2e-3) - at(0.0)) / 4e-6, slope, 1e-3 * std::fabs(slope));
  EXPECT_EQ(at(1e-3), at(-1e-3));
  EXPECT_NEAR(at(1e-7), at(0.0), 1e-11);
}

TEST(HierarchicalScatter, ALevelHasTheProductThatIsWorkedByHand) {
  // Two yes and one no at p = 0.3 with phi = 0.25, rho = 0.2: 0.3 (0.3 + 0.25) 0.7 / (1 (1 +
  // 0.25) (1 + 0.5)) = 0.0616
  const double log_yes = std::log(0.3), log_no = std::log(0.7);
  const double value = scattered_value(2.0, log_yes, 0.25) +
                       scattered_value(1.0, log_no, 0.25) - scatter_total(3.0, 0.25).value;
  EXPECT_NEAR(std::exp(value), 0.0616, 1e-15);
  EXPECT_NEAR(value, log_beta_binomial(2.0, 3.0, 0.3, 0.2), 1e-13);
}

TEST(HierarchicalScatter, ALevelsDerivativesAreThoseOfItsValue) {
  // The test chooses d ln p / dz = 1, and a density whose derivative is -z.
  constexpr double kStep = 1e-5, kPhi = 0.4;
  const auto value = [](double p, double phi) {
    return scattered_value(7.0, std::log(p), phi);
  };
  const ScatteredSide side = scattered_side(7.0, std::log(0.3), 1.0, 2.0, kPhi);
  EXPECT_NEAR(side.value, value(0.3, kPhi), 1e-13);
  const double by_p = (value(0.3 + kStep, kPhi) - value(0.3 - kStep, kPhi)) / (2.0 * kStep);
  EXPECT_NEAR(side.by_z, 0.3 * by_p, 1e-7);
  EXPECT_NEAR(side.by_lapse, 2.0 * 0.3 * by_p, 1e-7);
  EXPECT_NEAR(side.by_scatter,
              (value(0.3, kPhi + kStep) - value(0.3, kPhi - kStep)) / (2.0 * kStep), 1e-7);
  const double twice =
      (value(0.3 + 1e-4, kPhi) - 2.0 * value(0.3, kPhi) + value(0.3 - 1e-4, kPhi)) / 1e-8;
  EXPECT_NEAR(side.squares, -0.09 * twice, 1e-5);
  const ScatterTotal total = scatter_total(12.0, kPhi);
  EXPECT_NEAR(
      total.by_scatter,
      (scatter_total(12.0, kPhi + kStep).value - scatter_total(12.0, kPhi - kStep).value) /
          (2.0 * kStep),
      1e-7);
}

TEST(HierarchicalScatter, ManyAnswersToALevelAreAsManyFactors) {
  // Up to 2,000 factors are multiplied. For more, gamma functions are used.
  double value = 0.0, by_phi = 0.0;
  for (int j = 1; j < 2500; ++j) {
    value += std::log(0.2 + 0.05 * j);
    by_phi += j / (0.2 + 0.05 * j);
  }
  const ScatteredSide side = scattered_side(2500.0, std::log(0.2), 1.0, 0.0, 0.05);
  EXPECT_NEAR(side.value, std::log(0.2) + value, 1e-7);
  EXPECT_NEAR(side.by_scatter, by_phi, 1e-6 * by_phi);
  EXPECT_NEAR(scattered_value(2500.0, std::log(0.2), 0.05), side.value, 1e-9);
}

TEST(HierarchicalScatter, OnePersonsIntegralIsThatOfBruteForce) {
  const HierarchicalPerson person = some_person();
  const HierarchicalLikelihood likelihood(structure_with(true, false, true), {person}, 25);
  const double r = 0.45, v = 0.25;
  const double rho = std::pow(std::sin(r), 2), lapse = 0.5 * std::pow(std::sin(v), 2);
  const double by_hand = normal_mean([&](double first) {
    return normal_mean([&](double second) {
      return std::exp(log_answers(person, 0.7 + 0.4 * first, 0.1 + 0.3 * second, lapse, rho));
    });
  });
  const Eigen::VectorXd at = vector_of({0.7, 0.1, 0.4, 0.3, r, v});
  EXPECT_NEAR(likelihood.of_people(at)(0), std::log(by_hand), 1e-6);
}

TEST(HierarchicalScatter, OwnLapsesAreIntegratedOverBothOfTheirModes) {
  // This person lapses. The angle v + tau b is about equally likely near 0.6 and near -0.6.
  HierarchicalPerson person = some_person();
  person[0].num_yes = {3.0, 3.0, 6.0, 7.0, 9.0};
  person[0].num_no = {9.0, 8.0, 4.0, 3.0, 3.0};
  HierarchicalStructure structure = structure_with(true, true, true);
  structure.has_places = false;
  structure.loadings = {{0, 0, 1}};
  structure.num_random_effects = 1;
  structure.num_parameters = 5;
  const HierarchicalLikelihood likelihood(structure, {person}, 25);
  for (const double v : {0.0, 0.2}) {
    const double r = 0.2, tau = 0.5;
    const double by_hand = normal_mean([&](double deviation) {
      const double lapse = 0.5 * std::pow(std::sin(v + tau * deviation), 2);
      return normal_mean([&](double first) {
        return std::exp(
            log_answers(person, 1.5 + 0.4 * first, 0.0, lapse, std::pow(std::sin(r), 2)));
      });
    });
    const Eigen::VectorXd at = vector_of({1.5, 0.4, r, tau, v});
    EXPECT_NEAR(likelihood.of_people(at)(0), std::log(by_hand), 1e-5) << v;
  }
}

TEST(HierarchicalScatter, WithoutASpreadOwnLapsesAreCommonOnes) {
  const std::vector<HierarchicalPerson> people = {some_person(), some_person(2)};
  const HierarchicalLikelihood common(structure_with(true, false, true), people, 7);
  const HierarchicalLikelihood own(structure_with(true, true, true), people, 7);
  const double value = common(vector_of({0.7, 0.1, 0.3, 0.2, 0.3, 0.2}));
  EXPECT_NEAR(own(vector_of({0.7, 0.1, 0.3, 0.2, 0.3, 0.0, 0.2})), value, 1e-9);
}

TEST(HierarchicalScatter, GradientsAreTheDifferencesOfTheValue) {
  const std::vector<HierarchicalPerson> people = {some_person(), some_person(2),
                                                  some_person(1)};
  HierarchicalStructure structure = structure_with(true, true, true);
  structure.lapse_prior = {2.0, 30.0};
  const HierarchicalLikelihood likelihood(structure, people, 15);
  const Eigen::VectorXd at = vector_of({0.7, 0.1, 0.3, 0.2, 0.3, 0.25, 0.2});
  Eigen::VectorXd rise;
  (void)likelihood(at, &rise);
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    constexpr double kStep = 1e-4;
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(at.size(), i);
    const double slope = (likelihood(at + step) - likelihood(at - step)) / (2.0 * kStep);
    EXPECT_NEAR(rise(i), slope, 1e-4 * std::max(1.0, std::fabs(slope))) << "parameter " << i;
  }
}

TEST(HierarchicalScatter, OfAForcedChoiceGradientsAreThoseDifferencesToo) {
  HierarchicalStructure structure = structure_with(true, true, true);
  structure.guess_rate = 0.5;
  const HierarchicalLikelihood likelihood(structure, {some_person(3), some_person(4)}, 15);
  const Eigen::VectorXd at = vector_of({0.7, -0.4, 0.3, 0.2, 0.3, 0.25, 0.2});
  Eigen::VectorXd rise;
  (void)likelihood(at, &rise);
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    constexpr double kStep = 1e-4;
    const Eigen::VectorXd step = kStep * Eigen::VectorXd::Unit(at.size(), i);
    const double slope = (likelihood(at + step) - likelihood(at - step)) / (2.0 * kStep);
    EXPECT_NEAR(rise(i), slope, 1e-4 * std::max(1.0, std::fabs(slope))) << "parameter " << i;
  }
}

TEST(HierarchicalScatter, ThePriorIsOnTheMeanShareOfRandomAnswers) {
  HierarchicalStructure structure = structure_with(false, true, true);
  structure.lapse_prior = {3.0, 12.0};
  const double v = 0.3, tau = 0.4;
  const double share =
      normal_mean([&](double b) { return std::pow(std::sin(v + tau * b), 2); });
  const Eigen::VectorXd at = vector_of({0.7, 0.1, 0.3, 0.2, tau, v});
  EXPECT_NEAR(structure.mean_lapse_rate(at), 0.5 * share, 1e-12);
  EXPECT_NEAR(structure.lapse_rate(at), 0.5 * std::pow(std::sin(v), 2), 1e-15);
  EXPECT_NEAR(structure.log_prior(at), 2.0 * std::log(share) + 11.0 * std::log(1.0 - share),
              1e-9);
  // Without a spread, the rate is the share itself, and without options there is only the prior
  // Beta(1, 20).
  EXPECT_NEAR(structure_with(false, false, true).log_prior(vector_of({0, 0, 0, 0, v})),
              19.0 * std::log(std::pow(std::cos(v), 2)), 1e-12);
}

TEST(HierarchicalScatter, APriorsWeightIsThePowerOfItsDensity) {
  const BetaPrior half = BetaPrior{3.0, 21.0}.weighed(0.5);
  EXPECT_EQ(half.a, 2.0);
  EXPECT_EQ(half.b, 11.0);
  const BetaPrior none = kUsualLapsePrior.weighed(0.0);
  EXPECT_EQ(none.a, 1.0);
  EXPECT_EQ(none.b, 1.0);
}

}  // namespace hierarchical_scatter_test
}  // namespace jnd::analysis
