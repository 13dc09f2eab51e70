#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace jnd::analysis {

/// A symmetric matrix in the form of an arrow:
///
///     D1          B1
///         D2      B2
///             ..  ..
///     B1' B2' ..  C
///
/// The blocks D on the diagonal have one size. Each belongs to a group of the first grouping,
/// which should have the most groups times effects. The dense corner C belongs to all other
/// groupings. Only the columns of B in which the group has rows are stored. The matrix is
/// factorised block by block, and the corner by its Schur complement, so the cost grows only
/// linearly with the number of people. Not real time.
class ArrowMatrix {
 public:
  /// `touched` holds, for each block, the columns of the corner in which it has entries,
  /// ascending.
  ArrowMatrix(int block_size, int corner_size, std::vector<std::vector<int>> touched);

  [[nodiscard]] Eigen::Index size() const noexcept { return corner_begin_ + corner_size_; }
  /// The index at which the corner's part of a vector begins. That of a block begins at block *
  /// block_size.
  [[nodiscard]] Eigen::Index corner_begin() const noexcept { return corner_begin_; }
  /// The index of a corner column among the columns that the block touches.
  [[nodiscard]] int place_in(std::size_t block, int column) const;

  void set_identity();
  /// Adds weight * m m'. m has `head` (block_size values) in one block, and `tail` in the
  /// different `columns` of the corner. `places` are the indices of these columns among those
  /// that the block touches.
  void add(double weight, std::size_t block, const double* head, const double* tail,
           const int* columns, const int* places, int num_tail);

  /// Computes the Cholesky factors of the sum. Returns false if the matrix is not positive
  /// definite.
  [[nodiscard]] bool factorise();
  // The following functions need the factorised matrix.
  [[nodiscard]] double log_determinant() const noexcept { return log_determinant_; }
  /// Solves in place for one right-hand side.
  void solve(Eigen::VectorXd& vector) const;
  /// Computes those entries of the inverse at which the matrix itself has entries.
  void invert();

  /// Replaces `head` and `tail` by m' inverse at the entries of m, for the m of `add`.
  void times_inverse(std::size_t block, double* head, double* tail, const int* columns,
                     const int* places, int num_tail) const;

  /// The lower factor of one block. The entries above the diagonal do not belong to it.
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
  std::vector<double> diagonal_;       ///< The blocks D, and later their lower factors.
  std::vector<double> inverse_;        ///< The blocks of the inverse at D.
  std::vector<double> side_, solved_;  ///< The blocks B, and D^-1 B.
  std::vector<double> inverse_side_;   ///< The blocks of the inverse at B.
  Eigen::MatrixXd corner_, inverse_corner_;
  Eigen::LLT<Eigen::MatrixXd> corner_factor_;
  double log_determinant_ = 0.0;
};

}  // namespace jnd::analysis
