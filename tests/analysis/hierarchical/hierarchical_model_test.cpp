#include "analysis/hierarchical/hierarchical_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "analysis/hierarchical/hierarchical_arrangement.h"
#include "analysis/hierarchical/hierarchical_search.h"

namespace jnd::analysis {
namespace hierarchical_model_test {

/// Returns four people with unequal answers in `num_conditions` conditions. The last person
/// lacks the last condition.
HierarchicalArrangement people_in(int num_conditions) {
  std::vector<ParticipantAnswers> all;
  for (int person = 0; person < 4; ++person) {
    for (int condition = 0; condition < num_conditions; ++condition) {
      if (person == 3 && condition + 1 == num_conditions && num_conditions > 1) continue;
      ParticipantAnswers one{
          "P" + std::to_string(person), "c" + std::to_string(condition), 1.0, {}};
      const std::int64_t shift = (person + 2 * condition) % 3;
      for (const auto& [x, yes] : std::vector<std::pair<double, std::int64_t>>{
               {0.6, 1}, {0.8, 3}, {0.95, 5}, {1.1, 6}, {1.3, 8}, {1.7, 9}}) {
        one.rows.push_back({x, std::min<std::int64_t>(yes + shift, 12), 12});
      }
      all.push_back(std::move(one));
    }
  }
  return arranged(all);
}

/// Returns the same model with one change: every random effect also moves a number of another
/// condition, by a parameter that the tests keep at 0. Then nothing is independent, and the
/// integral uses all nodes.
HierarchicalStructure all_shared(HierarchicalStructure structure, int idle_parameter) {
  const std::vector<int> conditions = structure.conditions_of_effects();
  for (int effect = 0; effect < structure.num_random_effects; ++effect) {
    const int own = conditions[static_cast<std::size_t>(effect)];
    if (own == HierarchicalStructure::kSeveral) continue;
    structure.loadings.push_back(
        {(own + 1) % structure.num_conditions, effect, idle_parameter});
  }
  return structure;
}

class ManyConditions : public ::testing::TestWithParam<HierarchicalOptions> {};

TEST_P(ManyConditions, TheNestedSumIsThatOverAllNodes) {
  for (const int num_conditions : {2, 3}) {
    const HierarchicalArrangement all = people_in(num_conditions);
    HierarchicalStructure nested = structure_of(all, GetParam());
    // One more parameter, which moves nothing, stands at the end, before the angle of the lapse
    // rate.
    const int idle = nested.num_parameters - (nested.has_lapses ? 1 : 0);
    ++nested.num_parameters;
    const HierarchicalStructure whole = all_shared(nested, idle);
    Eigen::VectorXd at(nested.num_parameters);
    for (Eigen::Index i = 0; i < at.size(); ++i) {
      at(i) = 0.3 + 0.1 * std::sin(static_cast<double>(i));
    }
    at.head(num_conditions).array() += 0.8;
    at(idle) = 0.0;
    const HierarchicalLikelihood fast(nested, all.people, 3), slow(whole, all.people, 3);
    Eigen::MatrixXd fast_scores, slow_scores;
    const Eigen::VectorXd fast_values = fast.of_people(at, &fast_scores);
    const Eigen::VectorXd slow_values = slow.of_people(at, &slow_scores);
    EXPECT_LT((fast_values - slow_values).cwiseAbs().maxCoeff(), 1e-10);
    slow_scores.row(idle).setZero();
    EXPECT_LT((fast_scores - slow_scores).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_TRUE(fast_values.allFinite());
  }
}

INSTANTIATE_TEST_SUITE_P(
    Structures, ManyConditions,
    ::testing::Values(HierarchicalOptions{},
                      HierarchicalOptions{.slopes = HierarchicalSlopes::kShared},
                      HierarchicalOptions{.link = HierarchicalLink::kLinear,
                                          .lapses = HierarchicalLapses::kNone},
                      HierarchicalOptions{.pse = HierarchicalPse::kShared},
                      HierarchicalOptions{.pse = HierarchicalPse::kReference,
                                          .guess_rate = 0.5}));

TEST(HierarchicalModel, EffectsOfOneConditionComeBeforeThoseOfSeveral) {
  const HierarchicalArrangement all = people_in(3);
  const HierarchicalStructure structure = structure_of(all, {});
  EXPECT_EQ(structure.conditions_of_effects(),
            (std::vector<int>{0, 1, 2, HierarchicalStructure::kSeveral}));
  const HierarchicalStructure pair = structure_of(people_in(2), {});
  // The second of two correlated slopes has a part of its own.
  EXPECT_EQ(pair.conditions_of_effects(),
            (std::vector<int>{0, 1, 1, HierarchicalStructure::kSeveral}));
}

/// Returns `num_people` people in one condition, each with different answers to six levels.
HierarchicalArrangement different_people(int num_people) {
  std::vector<ParticipantAnswers> all;
  for (int person = 0; person < num_people; ++person) {
    ParticipantAnswers one{"P" + std::to_string(person), "", 1.0, {}};
    std::int64_t level = 0;
    for (const double x : {0.6, 0.8, 0.95, 1.1, 1.3, 1.7}) {
      const std::int64_t num_yes = 2 * level + (person * (level + 3) + level) % 4 - 1;
      one.rows.push_back({x, std::clamp<std::int64_t>(num_yes, 0, 12), 12});
      ++level;
    }
    all.push_back(std::move(one));
  }
  return arranged(all);
}

/// Returns parameters at which a fit may evaluate the likelihood: slope and place of the median
/// person, both spreads, and the angle of the lapse rate.
Eigen::VectorXd somewhere(const HierarchicalStructure& structure, double angle) {
  Eigen::VectorXd at(structure.num_parameters);
  at << 1.4, 0.05, 0.3, 0.1, angle;
  return at;
}

class ManyPeople : public ::testing::TestWithParam<HierarchicalOptions> {};

/// Thirty people need 14,580 probabilities, which come from a table. Two people need 972.
TEST_P(ManyPeople, HaveTheLikelihoodsThatFewOfThemHave) {
  const HierarchicalArrangement all = different_people(30);
  const HierarchicalStructure structure = structure_of(all, GetParam());
  const HierarchicalLikelihood many(structure, all.people, 9);
  ASSERT_TRUE(many.reads_a_table());
  for (const double angle : {0.0, 1e-3, 0.2}) {
    const Eigen::VectorXd at = somewhere(structure, angle);
    Eigen::MatrixXd scores;
    const Eigen::VectorXd values = many.of_people(at, &scores);
    double sum = 0.0;
    for (std::size_t first = 0; first < all.people.size(); first += 2) {
      const HierarchicalLikelihood two(structure, {all.people[first], all.people[first + 1]},
                                       9);
      ASSERT_FALSE(two.reads_a_table());
      Eigen::MatrixXd two_scores;
      const Eigen::VectorXd two_values = two.of_people(at, &two_scores);
      const auto place = static_cast<Eigen::Index>(first);
      EXPECT_LT((values.segment(place, 2) - two_values).cwiseAbs().maxCoeff(), 1e-8)
          << angle << ' ' << first;
      EXPECT_LT((scores.middleCols(place, 2) - two_scores).cwiseAbs().maxCoeff(), 1e-6)
          << angle << ' ' << first;
      sum += two_values.sum();
    }
    EXPECT_NEAR(many(at) - structure.log_prior(at), sum, 1e-9 * std::fabs(sum)) << angle;
    // Every parameter has an effect, because otherwise the comparison above would prove nothing
    // about it.
    EXPECT_GT(scores.topRows(4).cwiseAbs().rowwise().maxCoeff().minCoeff(), 0.1);
  }
}

/// The score is the gradient of the table's own likelihood, so that a search converges.
TEST_P(ManyPeople, HaveScoresThatAreTheSlopeOfTheirLikelihood) {
  const HierarchicalArrangement all = different_people(30);
  const HierarchicalStructure structure = structure_of(all, GetParam());
  const HierarchicalLikelihood many(structure, all.people, 9);
  ASSERT_TRUE(many.reads_a_table());
  const Eigen::VectorXd at = somewhere(structure, 0.2);
  Eigen::VectorXd gradient;
  (void)many(at, &gradient);
  for (Eigen::Index i = 0; i < at.size(); ++i) {
    const Eigen::VectorXd step = 1e-4 * Eigen::VectorXd::Unit(at.size(), i);
    // One gradient is that of the exact integral, the other that of a rule of nine nodes.
    EXPECT_NEAR(gradient(i), (many(at + step) - many(at - step)) / 2e-4,
                1e-3 * (1.0 + std::fabs(gradient(i))))
        << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Structures, ManyPeople,
                         ::testing::Values(HierarchicalOptions{},
                                           HierarchicalOptions{
                                               .link = HierarchicalLink::kLinear},
                                           HierarchicalOptions{.guess_rate = 0.5}));

/// The search begins with fewer nodes and with the table. Neither may influence where it ends.
TEST(HierarchicalModel, OfManyPeopleHasItsOptimumWhereTheExactScoresOfFewAddUpToNothing) {
  const HierarchicalArrangement all = different_people(30);
  const HierarchicalStructure structure = structure_of(all, {});
  const HierarchicalLikelihood many(structure, all.people, 9);
  ASSERT_TRUE(many.coarser().has_value());
  std::string reason;
  const auto start = start_of(all, structure, reason);
  ASSERT_TRUE(start.has_value()) << reason;
  const HierarchicalOptimum found = better_optimum(many, structure, *start);
  ASSERT_EQ(found.status, FitStatus::kOk) << found.reason;
  Eigen::VectorXd rise = Eigen::VectorXd::Zero(structure.num_parameters);
  double value = structure.log_prior(found.parameters);
  for (std::size_t first = 0; first < all.people.size(); first += 2) {
    const HierarchicalLikelihood two(structure, {all.people[first], all.people[first + 1]}, 9);
    Eigen::MatrixXd scores;
    value += two.of_people(found.parameters, &scores).sum();
    rise += scores.rowwise().sum();
  }
  structure.add_log_prior_rise(found.parameters, rise);
  EXPECT_LT((found.covariance * rise).cwiseAbs().maxCoeff(), 1e-7);
  EXPECT_NEAR(value, found.log_likelihood, 1e-9 * std::fabs(value));
}

TEST(HierarchicalModel, OfADozenPeopleReadsNoTable) {
  const HierarchicalArrangement all = different_people(12);
  const HierarchicalLikelihood dozen(structure_of(all, {}), all.people, 9);
  EXPECT_FALSE(dozen.reads_a_table());
  EXPECT_FALSE(dozen.coarser().has_value());
}

}  // namespace hierarchical_model_test
}  // namespace jnd::analysis
