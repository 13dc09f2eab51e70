#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace jnd::analysis {

/// A symmetric matrix of the form of an arrow:
///
///     D1          B1
///         D2      B2
///             ..  ..
///     B1' B2' ..  C
///
/// Blocks D of one size along the diagonal, one for each group of the grouping with the most
/// of them, and a dense corner C for all others. Of each B only the columns exist that its
/// group has rows in. It is factorised block by block, the corner by Schur's complement, so
/// that many people cost no more than their number. Not real time.
class ArrowMatrix {
 public:
  /// `touched`: of each block, the columns of the corner that it has a part in, ascending.
  ArrowMatrix(int block_size, int corner_size, std::vector<std::vector<int>> touched);

  [[nodiscard]] Eigen::Index size() const noexcept { return corner_begin_ + corner_size_; }
  /// Where the corner's part of a vector begins; that of a block begins at block * block_size.
  [[nodiscard]] Eigen::Index corner_begin() const noexcept { return corner_begin_; }
  /// Where a column of the corner is among those of the block that touches it.
  [[nodiscard]] int place_in(std::size_t block, int column) const;

  void set_identity();
  /// Adds weight * m m', m having `head` (block_size values) in one block and `tail` in the
  /// corner's `columns` (different ones), which stand at `places` in the block's own.
  void add(double weight, std::size_t block, const double* head, const double* tail,
           const int* columns, const int* places, int num_tail);

  /// Cholesky's factors of what was added up. False where it is not positive definite.
  [[nodiscard]] bool factorise();
  // Of the factorised matrix:
  [[nodiscard]] double log_determinant() const noexcept { return log_determinant_; }
  /// Solves for one right side, in its place.
  void solve(Eigen::VectorXd& vector) const;
  /// Makes those parts of the inverse that the matrix itself has entries in.
  void invert();

  /// m' inverse for the m of `add`, at the entries of m: `head` and `tail` are replaced.
  void times_inverse(std::size_t block, double* head, double* tail, const int* columns,
                     const int* places, int num_tail) const;

  /// The lower factor of one block; what stands above the diagonal is no part of it.
  [[nodiscard]] Eigen::Map<const Eigen::MatrixXd> factor(std::size_t block) const {
    return diagonal(block);
  }

 private:
  using Block = Eigen::Map<Eigen::MatrixXd>;
  using ConstBlock = Eigen::Map<const Eigen::MatrixXd>;
  [[nodiscard]] Block diagonal(std::size_t block);
  [[nodiscard]] ConstBlock diagonal(std::size_t block) const;
  [[nodiscard]] Block side(std::vector<double>& of, std::size_t block);
  [[nodiscard]] ConstBlock side(const std::vector<double>& of, std::size_t block) const;

  int block_size_, corner_size_;
  Eigen::Index corner_begin_ = 0;
  std::vector<std::vector<int>> touched_;
  std::vector<std::size_t> side_begin_;
  std::vector<double> diagonal_;       ///< D, then its lower factor.
  std::vector<double> inverse_;        ///< Blocks of the inverse on D.
  std::vector<double> side_, solved_;  ///< B, and D^-1 B.
  std::vector<double> inverse_side_;   ///< Of the inverse on B.
  Eigen::MatrixXd corner_, inverse_corner_;
  Eigen::LLT<Eigen::MatrixXd> corner_factor_;
  double log_determinant_ = 0.0;
};

}  // namespace jnd::analysis
