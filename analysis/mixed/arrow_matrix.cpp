#include "analysis/mixed/arrow_matrix.h"

#include <algorithm>
#include <cmath>

namespace jnd::analysis {
namespace {

/// Replaces a small matrix by its lower Cholesky factor. Returns false if it has none.
bool factorise_small(double* a, int size) {
  for (int j = 0; j < size; ++j) {
    for (int i = j; i < size; ++i) {
      double sum = a[i + j * size];
      for (int k = 0; k < j; ++k) sum -= a[i + k * size] * a[j + k * size];
      if (i == j) {
        if (!(sum > 0.0)) return false;
        a[j + j * size] = std::sqrt(sum);
      } else {
        a[i + j * size] = sum / a[j + j * size];
      }
    }
  }
  return true;
}

/// Solves L x = b in place.
void solve_lower_small(const double* l, int size, double* x) {
  for (int i = 0; i < size; ++i) {
    for (int k = 0; k < i; ++k) x[i] -= l[i + k * size] * x[k];
    x[i] /= l[i + i * size];
  }
}

/// Solves L' x = b in place.
void solve_upper_small(const double* l, int size, double* x) {
  for (int i = size - 1; i >= 0; --i) {
    for (int k = i + 1; k < size; ++k) x[i] -= l[k + i * size] * x[k];
    x[i] /= l[i + i * size];
  }
}

}  // namespace

ArrowMatrix::ArrowMatrix(int block_size, int corner_size, std::vector<std::vector<int>> touched)
    : block_size_(block_size), corner_size_(corner_size), touched_(std::move(touched)) {
  corner_begin_ = static_cast<Eigen::Index>(touched_.size()) * block_size;
  diagonal_.resize(touched_.size() * static_cast<std::size_t>(block_size * block_size));
  std::size_t begin = 0;
  for (const std::vector<int>& columns : touched_) {
    side_begin_.push_back(begin);
    begin += columns.size() * static_cast<std::size_t>(block_size);
  }
  side_.resize(begin);
  solved_.resize(begin);
  corner_.resize(corner_size, corner_size);
}

int ArrowMatrix::place_in(std::size_t block, int column) const {
  const std::vector<int>& columns = touched_[block];
  return static_cast<int>(std::ranges::lower_bound(columns, column) - columns.begin());
}

ArrowMatrix::Block ArrowMatrix::diagonal(std::size_t block) {
  return {diagonal_.data() + block * static_cast<std::size_t>(block_size_ * block_size_),
          block_size_, block_size_};
}
ArrowMatrix::ConstBlock ArrowMatrix::diagonal(std::size_t block) const {
  return {diagonal_.data() + block * static_cast<std::size_t>(block_size_ * block_size_),
          block_size_, block_size_};
}
ArrowMatrix::Block ArrowMatrix::side(std::vector<double>& of, std::size_t block) {
  return {of.data() + side_begin_[block], block_size_,
          static_cast<Eigen::Index>(touched_[block].size())};
}
ArrowMatrix::ConstBlock ArrowMatrix::side(const std::vector<double>& of,
                                          std::size_t block) const {
  return {of.data() + side_begin_[block], block_size_,
          static_cast<Eigen::Index>(touched_[block].size())};
}

void ArrowMatrix::set_identity() {
  std::ranges::fill(diagonal_, 0.0);
  std::ranges::fill(side_, 0.0);
  for (std::size_t block = 0; block < touched_.size(); ++block) {
    diagonal(block).diagonal().setOnes();
  }
  corner_.setIdentity();
}

void ArrowMatrix::add(double weight, std::size_t block, const double* head, const double* tail,
                      const int* columns, const int* places, int num_tail) {
  const int size = block_size_;
  double* d = diagonal_.data() + block * static_cast<std::size_t>(size * size);
  for (int j = 0; j < size; ++j) {
    const double weighted = weight * head[j];
    for (int i = j; i < size; ++i) d[i + j * size] += weighted * head[i];
  }
  double* b = side_.data() + side_begin_[block];
  for (int j = 0; j < num_tail; ++j) {
    const double weighted = weight * tail[j];
    for (int i = 0; i < size; ++i) b[i + places[j] * size] += weighted * head[i];
    for (int i = 0; i < num_tail; ++i) {
      if (columns[i] >= columns[j]) corner_(columns[i], columns[j]) += weighted * tail[i];
    }
  }
}

bool ArrowMatrix::factorise() {
  double log_root = 0.0;
  for (std::size_t block = 0; block < touched_.size(); ++block) {
    double* d = diagonal_.data() + block * static_cast<std::size_t>(block_size_ * block_size_);
    if (!factorise_small(d, block_size_)) return false;
    for (int i = 0; i < block_size_; ++i) log_root += std::log(d[i + i * block_size_]);
    Block solved = side(solved_, block);
    solved = side(side_, block);
    const std::vector<int>& columns = touched_[block];
    for (Eigen::Index j = 0; j < solved.cols(); ++j) {
      solve_lower_small(d, block_size_, solved.col(j).data());
    }
    // B' D^-1 B is subtracted from the corner.
    for (std::size_t j = 0; j < columns.size(); ++j) {
      for (std::size_t i = j; i < columns.size(); ++i) {
        corner_(columns[i], columns[j]) -= solved.col(static_cast<Eigen::Index>(i))
                                               .dot(solved.col(static_cast<Eigen::Index>(j)));
      }
    }
    for (Eigen::Index j = 0; j < solved.cols(); ++j) {
      solve_upper_small(d, block_size_, solved.col(j).data());
    }
  }
  if (corner_size_ > 0) {
    corner_factor_.compute(corner_.selfadjointView<Eigen::Lower>());
    if (corner_factor_.info() != Eigen::Success) return false;
    log_root += corner_factor_.matrixLLT().diagonal().array().log().sum();
  }
  log_determinant_ = 2.0 * log_root;
  return std::isfinite(log_determinant_);
}

void ArrowMatrix::solve(Eigen::VectorXd& vector) const {
  // The corner is solved first: C_S y = c - sum B' D^-1 a. Then each block is solved: D x = a -
  // B y.
  for (std::size_t block = 0; block < touched_.size(); ++block) {
    const auto head =
        vector.segment(static_cast<Eigen::Index>(block) * block_size_, block_size_);
    const ConstBlock solved = side(solved_, block);
    for (std::size_t j = 0; j < touched_[block].size(); ++j) {
      vector[corner_begin_ + touched_[block][j]] -=
          solved.col(static_cast<Eigen::Index>(j)).dot(head);
    }
  }
  if (corner_size_ > 0) {
    vector.tail(corner_size_) = corner_factor_.solve(vector.tail(corner_size_)).eval();
  }
  for (std::size_t block = 0; block < touched_.size(); ++block) {
    auto head = vector.segment(static_cast<Eigen::Index>(block) * block_size_, block_size_);
    const double* d =
        diagonal_.data() + block * static_cast<std::size_t>(block_size_ * block_size_);
    solve_lower_small(d, block_size_, head.data());
    solve_upper_small(d, block_size_, head.data());
    const ConstBlock solved = side(solved_, block);
    for (std::size_t j = 0; j < touched_[block].size(); ++j) {
      head -=
          solved.col(static_cast<Eigen::Index>(j)) * vector[corner_begin_ + touched_[block][j]];
    }
  }
}

void ArrowMatrix::invert() {
  if (corner_size_ > 0) {
    inverse_corner_ =
        corner_factor_.solve(Eigen::MatrixXd::Identity(corner_size_, corner_size_));
  }
  inverse_.resize(diagonal_.size());
  inverse_side_.resize(side_.size());
  const int size = block_size_;
  for (std::size_t block = 0; block < touched_.size(); ++block) {
    const double* d = diagonal_.data() + block * static_cast<std::size_t>(size * size);
    Block inverse(inverse_.data() + block * static_cast<std::size_t>(size * size), size, size);
    inverse.setIdentity();
    for (int j = 0; j < size; ++j) {
      solve_lower_small(d, size, inverse.col(j).data());
      solve_upper_small(d, size, inverse.col(j).data());
    }
    const std::vector<int>& columns = touched_[block];
    if (columns.empty()) continue;
    const auto of_corner = inverse_corner_(columns, columns);
    const Block solved = side(solved_, block);
    Block beside = side(inverse_side_, block);
    beside.noalias() = -solved * of_corner;
    inverse.noalias() -= beside * solved.transpose();
  }
}

void ArrowMatrix::times_inverse(std::size_t block, double* head, double* tail,
                                const int* columns, const int* places, int num_tail) const {
  const int size = block_size_;
  const double* inverse = inverse_.data() + block * static_cast<std::size_t>(size * size);
  const double* beside = inverse_side_.data() + side_begin_[block];
  constexpr int kMostAtOnce = 64;
  double copy[kMostAtOnce];
  Eigen::VectorXd long_copy;
  double* result = copy;
  if (size + num_tail > kMostAtOnce) {
    long_copy.resize(size + num_tail);
    result = long_copy.data();
  }
  for (int i = 0; i < size; ++i) {
    double sum = 0.0;
    for (int k = 0; k < size; ++k) sum += inverse[i + k * size] * head[k];
    for (int k = 0; k < num_tail; ++k) sum += beside[i + places[k] * size] * tail[k];
    result[i] = sum;
  }
  for (int i = 0; i < num_tail; ++i) {
    double sum = 0.0;
    for (int k = 0; k < size; ++k) sum += beside[k + places[i] * size] * head[k];
    for (int k = 0; k < num_tail; ++k) {
      sum += inverse_corner_(columns[i], columns[k]) * tail[k];
    }
    result[size + i] = sum;
  }
  std::copy(result, result + size, head);
  std::copy(result + size, result + size + num_tail, tail);
}

}  // namespace jnd::analysis
