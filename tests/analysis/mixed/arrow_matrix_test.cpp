#include "analysis/mixed/arrow_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace jnd::analysis {
namespace arrow_matrix_test {

/// A matrix of three blocks of two beside a corner of three. The second block touches two
/// columns of the corner.
struct Example {
  ArrowMatrix arrow{2, 3, {{0, 1, 2}, {0, 2}, {}}};
  Eigen::MatrixXd dense = Eigen::MatrixXd::Identity(9, 9);

  void add(double weight, std::size_t block, std::vector<double> head, std::vector<double> tail,
           std::vector<int> columns) {
    std::vector<int> places;
    for (const int column : columns) places.push_back(arrow.place_in(block, column));
    arrow.add(weight, block, head.data(), tail.data(), columns.data(), places.data(),
              static_cast<int>(columns.size()));
    const Eigen::VectorXd m = vector(block, head, tail, columns);
    dense += weight * m * m.transpose();
  }
  [[nodiscard]] static Eigen::VectorXd vector(std::size_t block,
                                              const std::vector<double>& head,
                                              const std::vector<double>& tail,
                                              const std::vector<int>& columns) {
    Eigen::VectorXd m = Eigen::VectorXd::Zero(9);
    for (int i = 0; i < 2; ++i) m[static_cast<int>(block) * 2 + i] = head[i];
    for (std::size_t i = 0; i < columns.size(); ++i) m[6 + columns[i]] = tail[i];
    return m;
  }
  Example() {
    arrow.set_identity();
    add(0.7, 0, {1.0, 0.5}, {0.3, -0.2}, {0, 1});
    add(1.3, 0, {1.0, -1.5}, {0.9, 0.4}, {2, 0});
    add(2.0, 1, {-0.4, 1.0}, {1.1, 0.2}, {0, 2});
    add(0.5, 2, {1.0, 2.0}, {}, {});
  }
};

TEST(ArrowMatrix, HasTheDeterminantOfTheWholeMatrix) {
  Example example;
  ASSERT_TRUE(example.arrow.factorise());
  EXPECT_NEAR(example.arrow.log_determinant(), std::log(example.dense.determinant()), 1e-13);
}

TEST(ArrowMatrix, SolvesAsTheWholeMatrix) {
  Example example;
  ASSERT_TRUE(example.arrow.factorise());
  Eigen::VectorXd x = Eigen::VectorXd::LinSpaced(9, -1.0, 2.0);
  const Eigen::VectorXd expected = example.dense.lu().solve(x);
  example.arrow.solve(x);
  EXPECT_LT((x - expected).norm(), 1e-13);
}

TEST(ArrowMatrix, HasTheInverseWhereItHasEntries) {
  Example example;
  ASSERT_TRUE(example.arrow.factorise());
  example.arrow.invert();
  const Eigen::MatrixXd inverse = example.dense.inverse();
  std::vector<double> head = {0.6, -1.0}, tail = {0.8, 0.3};
  const std::vector<int> columns = {2, 0}, places = {1, 0};
  const Eigen::VectorXd expected = inverse * Example::vector(1, head, tail, columns);
  example.arrow.times_inverse(1, head.data(), tail.data(), columns.data(), places.data(), 2);
  EXPECT_NEAR(head[0], expected[2], 1e-13);
  EXPECT_NEAR(head[1], expected[3], 1e-13);
  EXPECT_NEAR(tail[0], expected[8], 1e-13);
  EXPECT_NEAR(tail[1], expected[6], 1e-13);
}

TEST(ArrowMatrix, SaysWhereItIsNotPositive) {
  ArrowMatrix arrow(1, 0, {{}, {}});
  arrow.set_identity();
  const double one = 1.0;
  arrow.add(-2.0, 1, &one, nullptr, nullptr, nullptr, 0);
  EXPECT_FALSE(arrow.factorise());
}

}  // namespace arrow_matrix_test
}  // namespace jnd::analysis
