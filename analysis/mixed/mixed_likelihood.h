#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "analysis/hierarchical/hierarchical_quadrature.h"
#include "analysis/mixed/arrow_matrix.h"
#include "analysis/mixed/mixed_model.h"

namespace jnd::analysis {

/// The log-likelihood of a mixed model, integrated over how groups differ. With l the
/// log-likelihood of the answers given u, u~ the mode of f(u) = l(u) - u'u / 2, W the expected
/// information of each eta there and M = Z Lambda,
///
///     ln L = f(u~) - 1/2 ln |M' W M + I|          (Laplace's approximation; one node)
///
/// with the expected information as lme4 has it (Bates, Mächler, Bolker and Walker 2015), and
/// with several nodes the rule of Gauss and Hermite centred and scaled there (Pinheiro and
/// Bates 1995), for one grouping. The coefficients ln C(n, y) are part of it.
///
/// It keeps the modes from one evaluation to the next, as a start, so that one of them serves
/// one search at a time. Not real time.
class MixedLikelihood {
 public:
  /// Throws `core::Error` for several nodes and several groupings, or a grid of more than
  /// 100,000 of them. `model` has to outlive this.
  MixedLikelihood(const MixedModel& model, int num_nodes);

  [[nodiscard]] int num_parameters() const noexcept { return num_parameters_; }

  /// None where the numbers have left their range. `parameters` as
  /// `MixedModel::num_parameters` says.
  [[nodiscard]] std::optional<double> value(const Eigen::VectorXd& parameters);

  /// The same with its exact gradient, to which the modes contribute by their implicit
  /// derivative.
  [[nodiscard]] std::optional<double> value(const Eigen::VectorXd& parameters,
                                            Eigen::VectorXd& gradient);

  /// Forgets the modes: where a search goes on elsewhere.
  void restart() { modes_.setZero(); }

 private:
  /// What the rows say at the present modes.
  struct RowState {
    Eigen::VectorXd score;     ///< dl/deta
    Eigen::VectorXd observed;  ///< -d2l/deta2
    Eigen::VectorXd expected;  ///< Its expectation.
    Eigen::VectorXd drift;     ///< d expected / deta
  };

  void set_parameters(const Eigen::VectorXd& parameters);
  [[nodiscard]] std::size_t first_group(std::size_t row) const {
    return model_.groupings[0].group[row];
  }
  /// M u of one row, and M' with a weight added to a vector.
  [[nodiscard]] double mixed_part(std::size_t row, const Eigen::VectorXd& u) const;
  void add_transposed(std::size_t row, double weight, Eigen::VectorXd& to) const;
  [[nodiscard]] double log_density(const Eigen::VectorXd& u) const;
  void evaluate_rows(const Eigen::VectorXd& u);
  [[nodiscard]] bool factorise(const Eigen::VectorXd& weights);
  [[nodiscard]] std::optional<double> find_modes();

  // mixed_quadrature.cpp
  /// What the nodes of one group come to: f at each with its own normal density taken out, and
  /// where they are, a column each.
  struct GroupNodes {
    Eigen::MatrixXd u;
    Eigen::VectorXd height;
    Eigen::MatrixXd score;  ///< Rows of the group x nodes; where it is asked for.
  };
  void evaluate_nodes(std::size_t group, bool with_score, GroupNodes& nodes) const;
  /// ln of the integral of exp(f), ln |L| aside.
  [[nodiscard]] double quadrature_sum() const;

  // mixed_gradient.cpp
  /// Derivatives while they are added up.
  struct GradientParts {
    Eigen::VectorXd pull;    ///< By eta of each row.
    Eigen::VectorXd change;  ///< Of what depends on the information, by eta of each row.
    Eigen::VectorXd modes;   ///< By the modes, from what the likelihood is not level in there.
    std::vector<Eigen::MatrixXd> loadings;  ///< By Lambda of each grouping.
  };
  [[nodiscard]] bool add_gradient(Eigen::VectorXd& gradient);
  void add_laplace(GradientParts& parts);
  void add_quadrature(GradientParts& parts) const;
  [[nodiscard]] bool add_through_modes(GradientParts& parts);

  const MixedModel& model_;
  GaussHermiteGrid grid_;
  int num_nodes_, num_parameters_;
  int head_size_ = 0, tail_size_ = 0;     ///< Effects of the first grouping, and of all others.
  std::vector<int> columns_, places_;     ///< Of each row's tail in the corner and its block.
  std::vector<std::size_t> group_begin_;  ///< Rows of each group of the first grouping.
  std::vector<Eigen::MatrixXd> loadings_;
  Eigen::VectorXd fixed_part_;  ///< X beta
  RowMatrix m_;                 ///< Rows x effects of all groupings: Z Lambda.
  Eigen::VectorXd modes_;
  RowState rows_;
  ArrowMatrix information_;
};

}  // namespace jnd::analysis
