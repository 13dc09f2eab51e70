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

/// The likelihood of everybody's answers, integrated over how people differ, by Gauss and
/// Hermite's rule centred and scaled at each person's own mode (Liu and Pierce 1994; Pinheiro
/// and Bates 1995). The scale is that of the expected information, as in lme4, so that one node
/// is its Laplace approximation; where answers scatter, that of quasi-likelihood.
///
/// Given the random effects that several conditions share, those of one condition alone are
/// independent of those of another. Where the structure numbers the former last, as
/// `structure_of` does, the sum over all nodes is one over the shared nodes of products of sums
/// over each condition's own: the same number in a time that grows by the conditions, not to
/// their power.
///
/// Own lapses are integrated by the trapezoidal rule, `LapseNodes`, at each of whose nodes the
/// rest is as with one lapse rate for everybody: the density of a person's lapse angle has two
/// modes where the person lapses, one on either side of 0, and is no normal one where not.
class HierarchicalLikelihood {
 public:
  HierarchicalLikelihood(const HierarchicalStructure& structure,
                         const std::vector<HierarchicalPerson>& people, int num_nodes);

  /// Log-likelihood without binomial coefficients, and log prior. `gradient`, where wanted, is
  /// the mean of the score over what the answers leave open of each person (Fisher's identity):
  /// that of the exact integral, near the rule's own.
  [[nodiscard]] double operator()(const Eigen::VectorXd& parameters,
                                  Eigen::VectorXd* gradient = nullptr) const;

  /// The log-likelihood of each person, without the prior. `scores`, where wanted, has a
  /// column a person: the gradient of that person's value, by the exact integral.
  [[nodiscard]] Eigen::VectorXd of_people(const Eigen::VectorXd& parameters,
                                          Eigen::MatrixXd* scores = nullptr) const;

  [[nodiscard]] std::size_t num_people() const noexcept { return people_.size(); }

  /// Whether the integral, own lapses aside, is one node's: Laplace's approximation.
  [[nodiscard]] bool is_laplace() const noexcept { return num_nodes_ == 1; }

  /// Of the same people with fewer nodes, whose optimum is near and found in a third of the
  /// time; none where there are few nodes or few people.
  [[nodiscard]] std::optional<HierarchicalLikelihood> coarser() const;

  /// Whether probabilities of answers are read off an `AnswerTable`, for they are so many.
  [[nodiscard]] bool reads_a_table() const noexcept { return has_table_; }

  /// Each person's most likely numbers, given the parameters and the person's answers.
  [[nodiscard]] std::vector<Eigen::VectorXd> modes(const Eigen::VectorXd& parameters) const;

  /// Each person's lapse rate there; everybody's where none has an own one.
  [[nodiscard]] std::vector<double> lapse_rates(const Eigen::VectorXd& parameters) const;

  /// Probability that answers of these curves, each person's own at the mode, lie as far from
  /// them as everybody's do; see `misfit_p_value`. What a mode follows a person's answers by is
  /// the trace of its hat matrix, less than one for each number of the person's own.
  [[nodiscard]] std::optional<double> misfit_p_value(const Eigen::VectorXd& parameters) const;

 private:
  static constexpr int kMostNumbers = 16;
  static constexpr int kCellNumbers = 3;  ///< Of a person in one condition: a, p, q.
  using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostNumbers, 1>;
  using Loadings = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostNumbers,
                                 kMostRandomEffects>;
  using Curvature = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRandomEffects,
                                  kMostRandomEffects>;
  using CellLoadings =
      Eigen::Matrix<double, kCellNumbers, Eigen::Dynamic, 0, kCellNumbers, kMostRandomEffects>;
  /// What the parameters say, before anybody's own deviations.
  struct Population {
    Numbers median;
    Loadings loadings;
    double lapse_rate = 0.0;
    double scatter = 0.0;  ///< phi of `scattered_side`; 0 where answers are independent.
    /// At the lapse rate; none where few answers are asked for.
    const AnswerTable* table = nullptr;

    [[nodiscard]] Numbers at(const RandomEffects& effects) const {
      return median + loadings * effects;
    }
  };
  struct Mode {
    RandomEffects at;
    Curvature information;  ///< Expected, prior included.
  };
  /// Of the log density of answers and random effects together, by the random effects; second
  /// derivatives are negated.
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
    std::array<double, kCellNumbers> numbers = {};  ///< In the order of `CellNumbers`.
    double lapse_rate = 0.0;
    double scatter = 0.0;  ///< By phi.
  };
  /// Of one person at one lapse rate, without what answers that scatter are divided by.
  struct Integral {
    double value = 0.0;            ///< ln
    Eigen::VectorXd by_parameter;  ///< But for the three angles and spreads that come last.
    double by_lapse_rate = 0.0, by_scatter = 0.0;
  };
  /// At one of a condition's own nodes.
  struct OwnNode {
    std::array<double, kMostRandomEffects> effects = {};
    CellScore score;
  };
  /// What the shared effects of a person are at one shared node.
  struct SharedNode {
    RandomEffects effects;  ///< The person's; those of one condition alone at the mode.
    RandomEffects away;     ///< From the mode, of those that are shared.
  };
  /// What one person's integral needs at each node, kept from person to person.
  struct Nodes {
    std::vector<double> shares, own_shares;  ///< Of the shared nodes, of a condition's own.
    std::vector<OwnNode> own;
    Eigen::MatrixXd by_parameter;  ///< A column a shared node.
    std::vector<double> by_lapse_rate, by_scatter;
  };
  /// A person at the mode, the lapse rate's own deviation b among what is sought.
  struct OwnMode {
    Mode mode;
    double lapse_rate = 0.0;
    double num_followed = 0.0;  ///< What the lapse rate follows the answers by, 0 to 1.
  };

  [[nodiscard]] Population population_of(const Eigen::VectorXd& parameters) const;
  /// How many probabilities of answers one value needs.
  [[nodiscard]] double num_probabilities() const;
  [[nodiscard]] AnswerProbabilities answer_at(double z, const Population& population,
                                              AnswersWanted wanted) const noexcept;
  /// Log-likelihood of a person with these numbers.
  [[nodiscard]] double log_likelihood(const HierarchicalPerson& person, const Numbers& numbers,
                                      const Population& population) const;
  /// That of one condition, and its derivatives where `score` is wanted.
  [[nodiscard]] double log_likelihood(const HierarchicalCell& cell, const CellNumbers& numbers,
                                      const Population& population,
                                      CellScore* score) const noexcept;
  /// The same of answers that do not scatter, off the table.
  template <bool kHasScores>
  [[nodiscard]] double tabled_log_likelihood(const HierarchicalCell& cell,
                                             const CellNumbers& numbers,
                                             const AnswerTable& table,
                                             CellScore* score) const noexcept;
  [[nodiscard]] CellNumbers numbers_in(int condition, const Numbers& numbers) const noexcept;
  /// Of a condition, a row each of a, p and q; 0 of what there is not.
  [[nodiscard]] CellLoadings loadings_in(int condition, const Population& population) const;
  /// ln of the sum over a condition's own nodes at one shared node, the `place`th, to whose
  /// scores its own are added.
  [[nodiscard]] double own_sum(const HierarchicalCell& cell, const Population& population,
                               const Mode& mode, const Curvature& upper,
                               const SharedNode& shared, std::size_t place, bool has_scores,
                               Nodes& nodes) const;
  [[nodiscard]] Integral integral_of(const HierarchicalPerson& person,
                                     const Population& population, const Mode& mode,
                                     bool has_scores, Nodes& nodes) const;
  /// The same over people's own lapse rates; derivatives by all parameters but r.
  [[nodiscard]] Integral own_lapses_integral(std::size_t person, const Population& population,
                                             const Eigen::VectorXd& parameters, bool has_scores,
                                             Nodes& nodes) const;
  [[nodiscard]] JointDerivatives joint_derivatives(const HierarchicalPerson& person,
                                                   const Population& population,
                                                   const RandomEffects& at) const;
  /// The answers of a person with these numbers, each level beside its probability of a yes.
  void add_fitted(const HierarchicalPerson& person, const Numbers& numbers, double lapse_rate,
                  std::vector<FittedAnswers>& answers) const;
  [[nodiscard]] Mode mode_of(const HierarchicalPerson& person, const Population& population,
                             const RandomEffects& start) const;
  [[nodiscard]] OwnMode own_mode_of(std::size_t person, const Population& population,
                                    const Eigen::VectorXd& parameters) const;
  /// The same people with the lapse rate of those with this b.
  [[nodiscard]] Population population_at(const Population& population,
                                         const Eigen::VectorXd& parameters,
                                         double deviation) const;

  HierarchicalStructure structure_;
  bool has_orders_ = false;  ///< In any condition.
  std::vector<HierarchicalPerson> people_;
  /// Random effects of one condition alone: the first, and how many. Those from
  /// `first_shared_` on are of several.
  struct OwnEffects {
    int first = 0, num = 0;
    GaussHermiteGrid grid;
    std::vector<double> heights;  ///< Of each node: ln weight + |node|^2 / 2.
  };
  /// A loading of a condition's numbers, the `number`th of `CellNumbers`.
  struct CellLoading {
    std::size_t number = 0;
    int random_effect = 0, parameter = 0;
  };
  std::vector<OwnEffects> own_;                     ///< By condition.
  std::vector<std::vector<CellLoading>> loadings_;  ///< By condition.
  int first_shared_ = 0;
  GaussHermiteGrid shared_grid_;
  int num_nodes_ = 1;       ///< In each dimension.
  bool has_table_ = false;  ///< One value asks for so many probabilities that a table pays.
  LapseNodes lapse_nodes_;  ///< A single one without own lapses.
  /// Of each person how many answers there are to a level, and to how many levels as many.
  std::vector<std::vector<std::pair<double, double>>> totals_;
  /// Modes found last, at each lapse node of each person: where the next search starts.
  mutable std::vector<RandomEffects> last_;
  /// Where `of_people` was asked last, and what it said: the searches ask again.
  mutable Eigen::VectorXd last_parameters_, last_values_;
  mutable Eigen::MatrixXd last_scores_;  ///< Empty where the values alone were asked for.
  mutable AnswerTable table_;
};

}  // namespace jnd::analysis
