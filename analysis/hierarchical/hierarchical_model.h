#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <utility>
#include <vector>

#include "analysis/fits/answer_scatter.h"
#include "analysis/hierarchical/answer_table.h"
#include "analysis/hierarchical/hierarchical_quadrature.h"
#include "analysis/hierarchical/hierarchical_structure.h"

namespace jnd::analysis {

/// The likelihood of everybody's answers, integrated over how people differ. It uses the
/// Gauss-Hermite rule, centred and scaled at each person's own mode (Liu and Pierce 1994;
/// Pinheiro and Bates 1995). The scale is that of the expected information, as in lme4, so one
/// node gives lme4's Laplace approximation. If answers scatter, it is that of quasi-likelihood.
///
/// Given the random effects that several conditions share, the effects of single conditions are
/// independent. If the structure numbers the shared effects last, as `structure_of` does, the
/// sum over all nodes becomes a sum over the shared nodes of products of sums over each
/// condition's own nodes. The number is the same, but the time grows in proportion to the
/// number of conditions instead of exponentially.
///
/// Lapse rates of people's own are integrated by the trapezoidal rule, `LapseNodes`. At each of
/// its nodes everything else is as with one lapse rate for everybody. The Gauss-Hermite rule
/// does not suit them: the density of a person's lapse angle has two modes, one on either side
/// of 0, if the person lapses, and is not normal otherwise.
class HierarchicalLikelihood {
 public:
  HierarchicalLikelihood(const HierarchicalStructure& structure,
                         const std::vector<HierarchicalPerson>& people, int num_nodes);

  /// The log-likelihood without binomial coefficients, plus the log prior. `gradient`, if
  /// wanted, is the mean of the score over the posterior of each person's random effects
  /// (Fisher's identity). It is the gradient of the exact integral, and close to that of the
  /// rule.
  [[nodiscard]] double operator()(const Eigen::VectorXd& parameters,
                                  Eigen::VectorXd* gradient = nullptr) const;

  /// The log-likelihood of each person, without the prior. `scores`, if wanted, has one column
  /// for each person: the gradient of the person's value, by the exact integral.
  [[nodiscard]] Eigen::VectorXd of_people(const Eigen::VectorXd& parameters,
                                          Eigen::MatrixXd* scores = nullptr) const;

  [[nodiscard]] std::size_t num_people() const noexcept { return people_.size(); }

  /// Whether the integral, apart from people's own lapse rates, has one node: Laplace's
  /// approximation.
  [[nodiscard]] bool is_laplace() const noexcept { return num_nodes_ == 1; }

  /// The likelihood of the same people with fewer nodes. Its optimum is near and takes a third
  /// of the time to find. It is absent if there are few nodes or few people.
  [[nodiscard]] std::optional<HierarchicalLikelihood> coarser() const;

  /// Whether so many probabilities are needed that they are read from an `AnswerTable`.
  [[nodiscard]] bool reads_a_table() const noexcept { return has_table_; }

  /// Each person's most likely numbers, given the parameters and the person's answers.
  [[nodiscard]] std::vector<Eigen::VectorXd> modes(const Eigen::VectorXd& parameters) const;

  /// Each person's lapse rate at the mode, or everybody's if people have none of their own.
  [[nodiscard]] std::vector<double> lapse_rates(const Eigen::VectorXd& parameters) const;

  /// The probability that answers which follow people's curves, each at the person's mode, lie
  /// as far from them as everybody's do; see `misfit_p_value`. The number of fitted parameters
  /// is the trace of each mode's hat matrix, which is less than one for each number of a
  /// person.
  [[nodiscard]] std::optional<double> misfit_p_value(const Eigen::VectorXd& parameters) const;

 private:
  static constexpr int kMostNumbers = 16;
  /// The numbers of a person in one condition: a, p, q.
  static constexpr int kCellNumbers = 3;
  using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostNumbers, 1>;
  using Loadings = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostNumbers,
                                 kMostRandomEffects>;
  using Curvature = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRandomEffects,
                                  kMostRandomEffects>;
  using CellLoadings =
      Eigen::Matrix<double, kCellNumbers, Eigen::Dynamic, 0, kCellNumbers, kMostRandomEffects>;
  /// What the parameters say about the population, before people's deviations.
  struct Population {
    Numbers median;
    Loadings loadings;
    double lapse_rate = 0.0;
    double scatter = 0.0;  ///< phi of `scattered_side`; 0 if answers are independent.
    /// The table at the lapse rate; null if few probabilities are needed.
    const AnswerTable* table = nullptr;

    [[nodiscard]] Numbers at(const RandomEffects& effects) const {
      return median + loadings * effects;
    }
  };
  struct Mode {
    RandomEffects at;
    Curvature information;  ///< The expected information, including the prior.
  };
  /// Derivatives of the joint log density of answers and random effects by the random effects.
  /// The second derivatives are negated.
  struct JointDerivatives {
    RandomEffects gradient;
    Curvature expected, observed;
  };

  /// A person's numbers in one condition.
  struct CellNumbers {
    double slope = 0.0, place = 0.0, by_interval = 0.0;  ///< a, p, q
  };
  /// Derivatives of the log-likelihood of one condition.
  struct CellScore {
    /// The derivatives in the order of `CellNumbers`.
    std::array<double, kCellNumbers> numbers = {};
    double lapse_rate = 0.0;
    double scatter = 0.0;  ///< The derivative by phi.
  };
  /// The integral for one person at one lapse rate, without the divisor of scattering answers.
  struct Integral {
    double value = 0.0;            ///< The logarithm of the integral.
    Eigen::VectorXd by_parameter;  ///< Without the three angles and spreads that come last.
    double by_lapse_rate = 0.0, by_scatter = 0.0;
  };
  /// The values at one of a condition's own nodes.
  struct OwnNode {
    std::array<double, kMostRandomEffects> effects = {};
    CellScore score;
  };
  /// A person's shared effects at one shared node.
  struct SharedNode {
    /// The person's effects. Those of single conditions are at the mode.
    RandomEffects effects;
    RandomEffects away;  ///< The distance of the shared effects from the mode.
  };
  /// The values that one person's integral needs at each node. The memory is reused from person
  /// to person.
  struct Nodes {
    /// The shares of the shared nodes and of a condition's own nodes.
    std::vector<double> shares, own_shares;
    std::vector<OwnNode> own;
    Eigen::MatrixXd by_parameter;  ///< One column for each shared node.
    std::vector<double> by_lapse_rate, by_scatter;
  };
  /// A person at the mode, which is also sought over the deviation b of the lapse rate.
  struct OwnMode {
    Mode mode;
    double lapse_rate = 0.0;
    /// How strongly the lapse rate follows the person's answers, 0 to 1.
    double num_followed = 0.0;
  };

  [[nodiscard]] Population population_of(const Eigen::VectorXd& parameters) const;
  /// The number of answer probabilities that one value needs.
  [[nodiscard]] double num_probabilities() const;
  [[nodiscard]] AnswerProbabilities answer_at(double z, const Population& population,
                                              AnswersWanted wanted) const noexcept;
  /// The log-likelihood of a person with these numbers.
  [[nodiscard]] double log_likelihood(const HierarchicalPerson& person, const Numbers& numbers,
                                      const Population& population) const;
  /// The log-likelihood of one condition, and its derivatives if `score` is not null.
  [[nodiscard]] double log_likelihood(const HierarchicalCell& cell, const CellNumbers& numbers,
                                      const Population& population,
                                      CellScore* score) const noexcept;
  /// The same from the table, for answers that do not scatter.
  template <bool kHasScores>
  [[nodiscard]] double tabled_log_likelihood(const HierarchicalCell& cell,
                                             const CellNumbers& numbers,
                                             const AnswerTable& table,
                                             CellScore* score) const noexcept;
  [[nodiscard]] CellNumbers numbers_in(int condition, const Numbers& numbers) const noexcept;
  /// The loadings of a condition, with a row for each of a, p and q. Rows of absent numbers are
  /// 0.
  [[nodiscard]] CellLoadings loadings_in(int condition, const Population& population) const;
  /// ln of the sum over a condition's own nodes at the shared node number `place`. It adds the
  /// condition's scores to the scores of that node.
  [[nodiscard]] double own_sum(const HierarchicalCell& cell, const Population& population,
                               const Mode& mode, const Curvature& upper,
                               const SharedNode& shared, std::size_t place, bool has_scores,
                               Nodes& nodes) const;
  [[nodiscard]] Integral integral_of(const HierarchicalPerson& person,
                                     const Population& population, const Mode& mode,
                                     bool has_scores, Nodes& nodes) const;
  /// The same integral over people's own lapse rates. It has derivatives by all parameters
  /// except r.
  [[nodiscard]] Integral own_lapses_integral(std::size_t person, const Population& population,
                                             const Eigen::VectorXd& parameters, bool has_scores,
                                             Nodes& nodes) const;
  [[nodiscard]] JointDerivatives joint_derivatives(const HierarchicalPerson& person,
                                                   const Population& population,
                                                   const RandomEffects& at) const;
  /// Adds the answers of a person with these numbers, with the probability of a yes at each
  /// level.
  void add_fitted(const HierarchicalPerson& person, const Numbers& numbers, double lapse_rate,
                  std::vector<FittedAnswers>& answers) const;
  [[nodiscard]] Mode mode_of(const HierarchicalPerson& person, const Population& population,
                             const RandomEffects& start) const;
  [[nodiscard]] OwnMode own_mode_of(std::size_t person, const Population& population,
                                    const Eigen::VectorXd& parameters) const;
  /// The population with the lapse rate of people whose deviation is b.
  [[nodiscard]] Population population_at(const Population& population,
                                         const Eigen::VectorXd& parameters,
                                         double deviation) const;

  HierarchicalStructure structure_;
  bool has_orders_ = false;  ///< Whether any condition has orders of the intervals.
  std::vector<HierarchicalPerson> people_;
  /// The random effects of a single condition: the first one, and their number. Those from
  /// `first_shared_` on belong to several conditions.
  struct OwnEffects {
    int first = 0, num = 0;
    GaussHermiteGrid grid;
    std::vector<double> heights;  ///< For each node, ln weight + |node|^2 / 2.
  };
  /// A loading on one of a condition's numbers. `number` is the index in `CellNumbers`.
  struct CellLoading {
    std::size_t number = 0;
    int random_effect = 0, parameter = 0;
  };
  std::vector<OwnEffects> own_;                     ///< Indexed by condition.
  std::vector<std::vector<CellLoading>> loadings_;  ///< Indexed by condition.
  int first_shared_ = 0;
  GaussHermiteGrid shared_grid_;
  int num_nodes_ = 1;  ///< The number of nodes in each dimension.
  /// Whether one value needs so many probabilities that a table saves time.
  bool has_table_ = false;
  /// The nodes of people's lapse rates; a single one if people have none of their own.
  LapseNodes lapse_nodes_;
  /// For each person, pairs of a number of answers to a level and the number of levels with as
  /// many.
  std::vector<std::vector<std::pair<double, double>>> totals_;
  /// The last modes at each lapse node of each person. The next search starts there.
  mutable std::vector<RandomEffects> last_;
  /// The last parameters given to `of_people` and its results, because searches ask for them
  /// again.
  mutable Eigen::VectorXd last_parameters_, last_values_;
  mutable Eigen::MatrixXd last_scores_;  ///< Empty if only the values were asked for.
  mutable AnswerTable table_;
};

}  // namespace jnd::analysis
