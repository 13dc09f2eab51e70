#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/hierarchical/hierarchical_quadrature.h"
#include "analysis/mixed/arrow_matrix.h"
#include "analysis/mixed/mixed_model.h"

namespace jnd::analysis {

/// The log-likelihood of a mixed model, integrated over how groups differ. l is the
/// log-likelihood of the answers given u, u~ the mode of f(u) = l(u) - u'u / 2, W the expected
/// information of each eta there, and M = Z Lambda. With one node it is Laplace's
/// approximation:
///
///     ln L = f(u~) - 1/2 ln |M' W M + I|
///
/// It uses the expected information as lme4 does (Bates, Mächler, Bolker and Walker 2015). With
/// several nodes, which need a single grouping, it is the Gauss-Hermite rule centred and scaled
/// at the mode (Pinheiro and Bates 1995). The coefficients ln C(n, y) are included.
///
/// The object keeps the modes from one evaluation to the next as a start, so it serves only one
/// search at a time. Not real time.
class MixedLikelihood {
 public:
  /// Throws `core::Error` for several nodes with several groupings, and for a grid of more than
  /// 100,000 nodes. `model` must outlive the object.
  MixedLikelihood(const MixedModel& model, int num_nodes);

  [[nodiscard]] int num_parameters() const noexcept { return num_parameters_; }

  /// Absent if numbers have left their range. `parameters` are in the order that
  /// `MixedModel::num_parameters` describes.
  [[nodiscard]] std::optional<double> value(const Eigen::VectorXd& parameters);

  /// The same with the exact gradient. The modes contribute to it by their implicit derivative.
  [[nodiscard]] std::optional<double> value(const Eigen::VectorXd& parameters,
                                            Eigen::VectorXd& gradient);

  /// Resets the modes, for a search that continues elsewhere.
  void restart() { modes_.setZero(); }

 private:
  /// The derivatives of the log-likelihood l by eta of each row, at the present modes.
  struct RowState {
    Eigen::VectorXd score;     ///< dl/deta
    Eigen::VectorXd observed;  ///< -d2l/deta2
    Eigen::VectorXd expected;  ///< The expectation of `observed`.
    Eigen::VectorXd drift;     ///< d expected / deta
  };

  void set_parameters(const Eigen::VectorXd& parameters);
  [[nodiscard]] std::size_t first_group(std::size_t row) const {
    return model_.groupings[0].group[row];
  }
  /// `mixed_part` is M u in one row. `add_transposed` adds that row of M, times a weight, to a
  /// vector.
  [[nodiscard]] double mixed_part(std::size_t row, const Eigen::VectorXd& u) const;
  void add_transposed(std::size_t row, double weight, Eigen::VectorXd& to) const;
  [[nodiscard]] double log_density(const Eigen::VectorXd& u) const;
  void evaluate_rows(const Eigen::VectorXd& u);
  [[nodiscard]] bool factorise(const Eigen::VectorXd& weights);
  [[nodiscard]] std::optional<double> find_modes();

  // Defined in mixed_quadrature.cpp:
  /// The values at the nodes of one group: f at each node with the node's own normal density
  /// removed, and the nodes themselves, one column each.
  struct GroupNodes {
    Eigen::MatrixXd u;
    Eigen::VectorXd height;
    Eigen::MatrixXd score;  ///< Rows of the group x nodes, if it is asked for.
  };
  void evaluate_nodes(std::size_t group, bool with_score, GroupNodes& nodes) const;
  /// ln of the integral of exp(f), without ln |L|.
  [[nodiscard]] double quadrature_sum() const;

  // Defined in mixed_gradient.cpp:
  /// Derivatives while they are being added up.
  struct GradientParts {
    Eigen::VectorXd pull;  ///< The derivative by eta of each row.
    /// The derivative by eta of each row of what depends on the information.
    Eigen::VectorXd change;
    Eigen::VectorXd modes;  ///< The derivative by the modes of what is not stationary there.
    std::vector<Eigen::MatrixXd> loadings;  ///< The derivatives by Lambda of each grouping.
  };
  [[nodiscard]] bool add_gradient(Eigen::VectorXd& gradient);
  void add_laplace(GradientParts& parts);
  void add_quadrature(GradientParts& parts) const;
  [[nodiscard]] bool add_through_modes(GradientParts& parts);

  const MixedModel& model_;
  GaussHermiteGrid grid_;
  int num_nodes_, num_parameters_;
  /// The numbers of effects of the first grouping and of all others.
  int head_size_ = 0, tail_size_ = 0;
  /// For each effect in a row's tail, its column in the corner and its index in the block.
  std::vector<int> columns_, places_;
  /// The index of the first row of each group of the first grouping.
  std::vector<std::size_t> group_begin_;
  std::vector<Eigen::MatrixXd> loadings_;
  Eigen::VectorXd fixed_part_;  ///< X beta
  RowMatrix m_;                 ///< Z Lambda: rows x effects of all groupings.
  Eigen::VectorXd modes_;
  RowState rows_;
  ArrowMatrix information_;
};

}  // namespace jnd::analysis
