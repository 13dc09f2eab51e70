#include <Eigen/LU>
#include <cmath>

#include "analysis/mixed/mixed_likelihood.h"

namespace jnd::analysis {

void MixedLikelihood::evaluate_nodes(std::size_t group, bool with_score,
                                     GroupNodes& nodes) const {
  const auto num_nodes = static_cast<Eigen::Index>(grid_.node.size());
  nodes.u.resize(head_size_, num_nodes);
  nodes.height.resize(num_nodes);
  for (Eigen::Index node = 0; node < num_nodes; ++node) {
    nodes.u.col(node) = grid_.node[static_cast<std::size_t>(node)];
    nodes.height[node] = 0.5 * nodes.u.col(node).squaredNorm();
  }
  // The nodes are centred at the mode and scaled by the information there.
  information_.factor(group).transpose().triangularView<Eigen::Upper>().solveInPlace(nodes.u);
  const std::size_t from = group_begin_[group], to = group_begin_[group + 1];
  nodes.u.colwise() +=
      modes_.segment(static_cast<Eigen::Index>(group) * head_size_, head_size_);
  nodes.height -= 0.5 * nodes.u.colwise().squaredNorm().transpose();
  if (with_score) nodes.score.resize(static_cast<Eigen::Index>(to - from), num_nodes);
  for (std::size_t row = from; row < to; ++row) {
    const auto at = static_cast<Eigen::Index>(row);
    const double yes = model_.num_yes[row], no = model_.num_trials[row] - yes;
    for (Eigen::Index node = 0; node < num_nodes; ++node) {
      const MixedCurvePoint point =
          curve_point(model_.curve, fixed_part_[at] + m_.row(at).dot(nodes.u.col(node)));
      nodes.height[node] +=
          (yes > 0.0 ? yes * point.log_yes : 0.0) + (no > 0.0 ? no * point.log_no : 0.0);
      if (with_score) {
        nodes.score(static_cast<Eigen::Index>(row - from), node) =
            yes * point.rise_yes - no * point.rise_no;
      }
    }
  }
}

double MixedLikelihood::quadrature_sum() const {
  double sum = 0.0;
  GroupNodes nodes;
  for (std::size_t group = 0; group < model_.groupings.front().num_groups; ++group) {
    evaluate_nodes(group, false, nodes);
    const double most = nodes.height.maxCoeff();
    double share = 0.0;
    for (std::size_t node = 0; node < grid_.node.size(); ++node) {
      share +=
          grid_.weight[node] * std::exp(nodes.height[static_cast<Eigen::Index>(node)] - most);
    }
    sum += most + std::log(share);
  }
  return sum;
}

/// Node u_k has the share p_k, the score s_k and the gradient g_k = M' s_k - u_k. The
/// information is L L'. The derivative by L is -sum p_k (u_k - u~) (L^-1 g_k)', minus 1 / L_ii
/// on the diagonal. The derivative by the information follows from it as in Murray (2016).
void MixedLikelihood::add_quadrature(GradientParts& parts) const {
  const MixedGrouping& grouping = model_.groupings.front();
  const auto num_nodes = static_cast<Eigen::Index>(grid_.node.size());
  GroupNodes nodes;
  Eigen::VectorXd share(num_nodes);
  for (std::size_t group = 0; group < grouping.num_groups; ++group) {
    evaluate_nodes(group, true, nodes);
    const double most = nodes.height.maxCoeff();
    for (Eigen::Index node = 0; node < num_nodes; ++node) {
      share[node] =
          grid_.weight[static_cast<std::size_t>(node)] * std::exp(nodes.height[node] - most);
    }
    share /= share.sum();
    const auto from = static_cast<Eigen::Index>(group_begin_[group]);
    const Eigen::Index num_rows = nodes.score.rows();
    const auto m = m_.middleRows(from, num_rows);
    const auto z = grouping.z.middleRows(from, num_rows);
    const Eigen::Index begin = static_cast<Eigen::Index>(group) * head_size_;
    const auto mode = modes_.segment(begin, head_size_);

    const Eigen::MatrixXd rise = m.transpose() * nodes.score - nodes.u;
    const Eigen::MatrixXd weighted_score = nodes.score * share.asDiagonal();
    parts.pull.segment(from, num_rows) = weighted_score.rowwise().sum();
    parts.loadings[0] += z.transpose() * weighted_score * nodes.u.transpose();
    parts.modes.segment(begin, head_size_) += rise * share;

    const auto l = information_.factor(group).triangularView<Eigen::Lower>();
    const Eigen::MatrixXd away = nodes.u.colwise() - Eigen::VectorXd(mode);
    Eigen::MatrixXd by_factor = -(away * share.asDiagonal() * l.solve(rise).transpose()).eval();
    by_factor.diagonal() -= information_.factor(group).diagonal().cwiseInverse();
    const Eigen::MatrixXd lower = l;
    Eigen::MatrixXd inner =
        (lower.transpose() * Eigen::MatrixXd(by_factor.triangularView<Eigen::Lower>()))
            .triangularView<Eigen::Lower>();
    inner.diagonal() *= 0.5;
    const Eigen::MatrixXd inverse = lower.inverse();
    const Eigen::MatrixXd by_information = inverse.transpose() * inner * inverse;
    const Eigen::MatrixXd even = 0.5 * (by_information + by_information.transpose());
    for (Eigen::Index i = 0; i < num_rows; ++i) {
      const Eigen::Index at = from + i;
      const Eigen::VectorXd image = even * m.row(i).transpose();
      parts.change[at] = rows_.drift[at] * m.row(i).dot(image);
      parts.loadings[0] += 2.0 * rows_.expected[at] * z.row(i).transpose() * image.transpose();
    }
  }
}

}  // namespace jnd::analysis
