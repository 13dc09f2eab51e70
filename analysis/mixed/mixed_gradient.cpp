#include <algorithm>

#include "analysis/mixed/mixed_likelihood.h"

// H = I + M' W M is the expected information, and H_o = I + M' O M the observed information at
// the modes. Then M' s = u~ gives du~ = H_o^-1 (dM' s - M' O d_eta), where d_eta is the change
// of eta with the modes held. Everything that moves with the modes is first added up in
// `change` and `modes`, so that this equation is solved only once.

namespace jnd::analysis {

bool MixedLikelihood::add_gradient(Eigen::VectorXd& gradient) {
  const auto num_rows = static_cast<Eigen::Index>(model_.num_rows());
  GradientParts parts{.pull = Eigen::VectorXd::Zero(num_rows),
                      .change = Eigen::VectorXd::Zero(num_rows),
                      .modes = Eigen::VectorXd::Zero(information_.size()),
                      .loadings = {}};
  for (const MixedGrouping& grouping : model_.groupings) {
    parts.loadings.emplace_back(
        Eigen::MatrixXd::Zero(grouping.num_effects(), grouping.num_effects()));
  }
  if (num_nodes_ > 1) {
    add_quadrature(parts);
  } else {
    add_laplace(parts);
  }
  if (!add_through_modes(parts)) return false;
  gradient.head(model_.num_fixed()) = model_.x.transpose() * parts.pull;
  Eigen::Index place = model_.num_fixed();
  for (std::size_t k = 0; k < parts.loadings.size(); ++k) {
    int begin = 0;
    for (const int term : model_.groupings[k].term_sizes) {
      for (int j = 0; j < term; ++j) {
        for (int i = j; i < term; ++i) {
          gradient[place++] = parts.loadings[k](begin + i, begin + j);
        }
      }
      begin += term;
    }
  }
  return gradient.allFinite();
}

/// Adds the derivatives of f(u~) - 1/2 ln |H|. f is stationary in the modes, and the derivative
/// by H is -H^-1 / 2.
void MixedLikelihood::add_laplace(GradientParts& parts) {
  const auto size = static_cast<std::size_t>(head_size_) + static_cast<std::size_t>(tail_size_);
  information_.invert();
  std::vector<double> image(size);
  for (std::size_t row = 0; row < model_.num_rows(); ++row) {
    const auto at = static_cast<Eigen::Index>(row);
    const double* m = m_.data() + row * size;
    const std::size_t tail = row * static_cast<std::size_t>(tail_size_);
    std::copy(m, m + size, image.begin());
    information_.times_inverse(first_group(row), image.data(), image.data() + head_size_,
                               columns_.data() + tail, places_.data() + tail, tail_size_);
    double leverage = 0.0;
    for (std::size_t i = 0; i < size; ++i) leverage += image[i] * m[i];
    parts.pull[at] = rows_.score[at];
    parts.change[at] = -0.5 * rows_.drift[at] * leverage;
    std::size_t of_row = 0;
    Eigen::Index begin = 0;
    for (std::size_t k = 0; k < parts.loadings.size(); ++k) {
      const MixedGrouping& grouping = model_.groupings[k];
      const int num = grouping.num_effects();
      const double* u = modes_.data() + begin + grouping.group[row] * num;
      for (int a = 0; a < num; ++a) {
        const double z = grouping.z(at, a);
        for (int b = 0; b <= a; ++b) {
          parts.loadings[k](a, b) +=
              z * (rows_.score[at] * u[b] -
                   rows_.expected[at] * image[of_row + static_cast<std::size_t>(b)]);
        }
      }
      of_row += static_cast<std::size_t>(num);
      begin += static_cast<Eigen::Index>(grouping.num_groups) * num;
    }
  }
}

bool MixedLikelihood::add_through_modes(GradientParts& parts) {
  const std::size_t num_rows = model_.num_rows();
  for (std::size_t row = 0; row < num_rows; ++row) {
    add_transposed(row, parts.change[static_cast<Eigen::Index>(row)], parts.modes);
  }
  // At a mode the observed information is positive definite. If rounding makes it seem
  // otherwise, the expected information is close to it.
  if (!factorise(rows_.observed) && !factorise(rows_.expected)) return false;
  information_.solve(parts.modes);
  for (std::size_t row = 0; row < num_rows; ++row) {
    const auto at = static_cast<Eigen::Index>(row);
    const double more = parts.change[at] - rows_.observed[at] * mixed_part(row, parts.modes);
    parts.pull[at] += more;
    Eigen::Index begin = 0;  // The index of the grouping's first effect among the modes.
    for (std::size_t k = 0; k < parts.loadings.size(); ++k) {
      const MixedGrouping& grouping = model_.groupings[k];
      const int num = grouping.num_effects();
      const Eigen::Index place = begin + static_cast<Eigen::Index>(grouping.group[row]) * num;
      for (int a = 0; a < num; ++a) {
        const double z = grouping.z(at, a);
        for (int b = 0; b <= a; ++b) {
          parts.loadings[k](a, b) +=
              z * (more * modes_[place + b] + rows_.score[at] * parts.modes[place + b]);
        }
      }
      begin += static_cast<Eigen::Index>(grouping.num_groups) * num;
    }
  }
  return true;
}

}  // namespace jnd::analysis
