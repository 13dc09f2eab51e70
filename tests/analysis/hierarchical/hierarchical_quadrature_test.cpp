#include "analysis/hierarchical/hierarchical_quadrature.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace jnd::analysis {
namespace hierarchical_quadrature_test {

TEST(HierarchicalQuadrature, ThreeNodesAreThoseOfTheTables) {
  const GaussHermiteGrid grid = gauss_hermite_grid(3, 1);
  ASSERT_EQ(grid.node.size(), 3U);
  EXPECT_NEAR(grid.node[0](0), -std::sqrt(3.0), 1e-14);
  EXPECT_NEAR(grid.node[1](0), 0.0, 1e-14);
  EXPECT_NEAR(grid.weight[0], 1.0 / 6.0, 1e-14);
  EXPECT_NEAR(grid.weight[1], 2.0 / 3.0, 1e-14);
}

TEST(HierarchicalQuadrature, MomentsOfTheNormalDistributionAreExact) {
  const GaussHermiteGrid grid = gauss_hermite_grid(6, 2);
  double one = 0.0, fourth = 0.0, mixed = 0.0, tenth = 0.0;
  for (std::size_t k = 0; k < grid.node.size(); ++k) {
    const double x = grid.node[k](0), y = grid.node[k](1);
    one += grid.weight[k];
    fourth += grid.weight[k] * std::pow(x, 4);
    mixed += grid.weight[k] * x * x * std::pow(y, 4);
    tenth += grid.weight[k] * std::pow(y, 10);
  }
  EXPECT_NEAR(one, 1.0, 1e-13);
  EXPECT_NEAR(fourth, 3.0, 1e-12);
  EXPECT_NEAR(mixed, 3.0, 1e-12);
  EXPECT_NEAR(tenth, 945.0, 1e-9);
}

TEST(HierarchicalQuadrature, OneNodeIsTheMean) {
  const GaussHermiteGrid grid = gauss_hermite_grid(1, 3);
  ASSERT_EQ(grid.node.size(), 1U);
  EXPECT_EQ(grid.node[0].norm(), 0.0);
  EXPECT_EQ(grid.weight[0], 1.0);
}

TEST(HierarchicalQuadrature, MoreDimensionsOrNodesThanItKnowsAreRefused) {
  EXPECT_THROW((void)gauss_hermite_grid(0, 1), core::Error);
  EXPECT_THROW((void)gauss_hermite_grid(62, 1), core::Error);
  EXPECT_THROW((void)gauss_hermite_grid(5, 6), core::Error);
}

}  // namespace hierarchical_quadrature_test
}  // namespace jnd::analysis
