#include "analysis/statistics/group_sequential.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"

namespace jnd::analysis {
namespace group_sequential_test {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

void expect_near(const std::vector<double>& found, const std::vector<double>& expected,
                 double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_NEAR(found[i], expected[i], tolerance) << "look " << i + 1;
  }
}

/// Returns the share of studies that cross these boundaries on either side, at equally spaced
/// looks.
double crossing(const std::vector<double>& boundaries, double drift) {
  std::vector<double> information;
  for (std::size_t look = 1; look <= boundaries.size(); ++look) {
    information.push_back(static_cast<double>(look) / static_cast<double>(boundaries.size()));
  }
  SequentialPaths paths(information, drift);
  double share = 0.0;
  for (const double z : boundaries) {
    share += paths.above(z) + paths.below(-z);
    if (&z != &boundaries.back()) paths.go_on(-z, z);
  }
  return share;
}

TEST(GroupSequential, SpendsWhatItsFormulasSay) {
  // Worked by hand: 2 (1 - Phi(2.2414 / sqrt 0.2)) and 0.05 ln(1 + (e - 1) / 2).
  EXPECT_NEAR(spent_alpha(SpendingFunction::kObrienFleming, 0.025, 0.2), 5.39e-7, 0.01e-7);
  EXPECT_NEAR(spent_alpha(SpendingFunction::kPocock, 0.05, 0.5), 0.031006, 1e-6);
  for (const auto spending : {SpendingFunction::kObrienFleming, SpendingFunction::kPocock}) {
    EXPECT_NEAR(spent_alpha(spending, 0.05, 1.0), 0.05, 1e-12) << "all of it in the end";
  }
  EXPECT_THROW((void)spent_alpha(SpendingFunction::kPocock, 0.05, 1.5), core::Error);
  EXPECT_THROW((void)spent_alpha(SpendingFunction::kPocock, 0.0, 0.5), core::Error);
}

// The boundaries are those of five equal looks at two-sided 0.05, as the programs of Reboussin,
// DeMets, Kim and Lan (2000, Controlled Clinical Trials 21, 190) give them.
TEST(GroupSequential, HasTheBoundariesOfLanAndDeMets) {
  const std::vector<int> looks = {10, 20, 30, 40, 50};
  expect_near(spending_boundaries(looks, SpendingFunction::kObrienFleming, 0.05, true),
              {4.8769, 3.3569, 2.6803, 2.2898, 2.0310}, 2e-4);
  expect_near(spending_boundaries(looks, SpendingFunction::kPocock, 0.05, true),
              {2.4380, 2.4268, 2.4101, 2.3966, 2.3859}, 2e-4);
  // One side of 0.025 has the same boundaries, because the other side contributes next to
  // nothing.
  expect_near(spending_boundaries(looks, SpendingFunction::kObrienFleming, 0.025, false),
              {4.8769, 3.3569, 2.6803, 2.2898, 2.0310}, 2e-4);
}

TEST(GroupSequential, OneLookIsAnOrdinaryTest) {
  expect_near(spending_boundaries({20}, SpendingFunction::kPocock, 0.05, true), {1.959964},
              1e-6);
  expect_near(spending_boundaries({20}, SpendingFunction::kObrienFleming, 0.05, false),
              {1.644854}, 1e-6);
}

// The constants are those of tests with boundaries C and C sqrt(K / k), two-sided 0.05:
// Jennison and Turnbull (2000), tables 2.1 and 2.3.
TEST(GroupSequential, CrossesPublishedBoundariesInFivePercentOfStudies) {
  const std::vector<std::pair<int, double>> pocock = {
      {2, 2.178}, {3, 2.289}, {4, 2.361}, {5, 2.413}, {10, 2.555}};
  for (const auto& [num_looks, constant] : pocock) {
    EXPECT_NEAR(crossing(std::vector<double>(static_cast<std::size_t>(num_looks), constant), 0),
                0.05, 1.5e-4)
        << num_looks;
  }
  const std::vector<std::pair<int, double>> obrien_fleming = {
      {2, 1.977}, {3, 2.004}, {4, 2.024}, {5, 2.040}, {10, 2.087}};
  for (const auto& [num_looks, constant] : obrien_fleming) {
    std::vector<double> boundaries;
    for (int look = 1; look <= num_looks; ++look) {
      boundaries.push_back(constant * std::sqrt(static_cast<double>(num_looks) / look));
    }
    EXPECT_NEAR(crossing(boundaries, 0), 0.05, 1.5e-4) << num_looks;
  }
}

// The same tables give the largest information for a power of 0.9, relative to a study without
// looks.
TEST(GroupSequential, HasThePublishedPowerUnderAnEffect) {
  const double fixed = 1.959964 + 1.281552;
  EXPECT_NEAR(crossing(std::vector<double>(5, 2.413), fixed * std::sqrt(1.207)), 0.9, 1e-3);
  std::vector<double> boundaries;
  for (int look = 1; look <= 5; ++look) boundaries.push_back(2.040 * std::sqrt(5.0 / look));
  EXPECT_NEAR(crossing(boundaries, fixed * std::sqrt(1.026)), 0.9, 1e-3);
}

TEST(GroupSequential, PathsGoSomewhereWhateverHappens) {
  for (const double drift : {0.0, 0.3, -1.5}) {
    SequentialPaths paths({12.0, 13.0, 60.0}, drift);
    double stopped = paths.above(2.0) + paths.below(-1.0);
    paths.go_on(-1.0, 2.0);
    stopped += paths.above(2.1) + paths.below(-kInfinite);
    paths.go_on(-kInfinite, 2.1);
    EXPECT_NEAR(stopped + paths.above(0.7) + paths.below(0.7), 1.0, 1e-9) << drift;
  }
}

TEST(GroupSequential, WantsLooksThatAscend) {
  EXPECT_THROW((void)spending_boundaries({12, 12}, SpendingFunction::kPocock, 0.05, true),
               core::Error);
  EXPECT_THROW((void)spending_boundaries({}, SpendingFunction::kPocock, 0.05, true),
               core::Error);
}

TEST(GroupSequential, WhereNextToNothingIsSpentNothingCanEndTheStudy) {
  const std::vector<double> z =
      spending_boundaries({1, 100}, SpendingFunction::kObrienFleming, 0.05, true);
  EXPECT_EQ(z[0], kInfinite);
  EXPECT_NEAR(z[1], 1.959964, 1e-6);
}

}  // namespace group_sequential_test
}  // namespace jnd::analysis
