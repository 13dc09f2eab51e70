#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <optional>
#include <vector>

#include "analysis/fits/answer_scatter.h"
#include "analysis/hierarchical/hierarchical_quadrature.h"

namespace jnd::analysis {

/// How a person's curve follows from the person's own numbers: three per condition, a slope
/// number a, a place number p and, where either interval may hold the test, an order number q
/// that moves the place to p + q o (o: `AnswerCount::order`), at u = ln(x / reference).
enum class HierarchicalLink {
  /// z = e^a (u - p): people differ by factors, a is -ln ln(1 + w), p is ln(pse / reference).
  kLogSlope,
  /// z = a u + p: linear, as mixed-model software has it; a may come out below 0.
  kLinear,
};

/// A condition's answers of one person, one entry a level.
struct HierarchicalCell {
  int condition = 0;
  std::vector<double> log_ratio, num_yes, num_no;
  std::vector<double> order;  ///< See `AnswerCount::order`.
};
using HierarchicalPerson = std::vector<HierarchicalCell>;

/// Which numbers there are and how they vary. The parameters, in this order: a of each
/// condition, p of each if `has_places`, q of each if any has orders, then the loadings' and,
/// if `has_lapses`, an angle v: a share sin^2 v of everybody's answers is random. Half of it is
/// a yes, so that
///
///     P(yes) = lapse + (1 - 2 lapse) Phi(z),   lapse = sin^2 v / 2,
///
/// or, where answers are right ones of a forced choice, as many as chance makes right:
///
///     P(right) = guess + (1 - guess - lapse) Phi(z),   lapse = (1 - guess) sin^2 v.
///
/// A person's numbers are those of the median person plus loadings times standard normal
/// numbers.
struct HierarchicalStructure {
  HierarchicalLink link = HierarchicalLink::kLogSlope;
  int num_conditions = 1;
  bool has_places = false;  ///< Otherwise every p is 0.
  /// Of each condition whether either interval may hold the test; else its q is 0.
  std::vector<bool> has_orders_in = {false};
  bool has_lapses = false;
  double known_lapse_rate = 0.0;  ///< Where it is no parameter: [0, `lapse_limit`).
  double guess_rate = 0.0;        ///< Of a forced choice among m: 1 / m, [0, 1); else 0.
  struct Loading {
    int number;         ///< Row: the person's number it moves.
    int random_effect;  ///< Column.
    int parameter;      ///< Which parameter it is; several loadings may share one.
  };
  std::vector<Loading> loadings;
  int num_random_effects = 1;
  int num_parameters = 2;

  [[nodiscard]] bool has_orders() const noexcept {
    return std::find(has_orders_in.begin(), has_orders_in.end(), true) != has_orders_in.end();
  }
  [[nodiscard]] int num_numbers() const noexcept {
    return num_conditions * (1 + (has_places ? 1 : 0) + (has_orders() ? 1 : 0));
  }
  [[nodiscard]] int place_at(int condition) const noexcept {
    return num_conditions + condition;
  }
  [[nodiscard]] int order_at(int condition) const noexcept {
    return num_conditions * (has_places ? 2 : 1) + condition;
  }
  /// Of the number that is a person's own beside the slope.
  [[nodiscard]] int own_place_at(int condition) const noexcept {
    return has_orders_in[static_cast<std::size_t>(condition)] ? order_at(condition)
                                                              : place_at(condition);
  }
  /// Which condition a number is of.
  [[nodiscard]] int condition_of(int number) const noexcept { return number % num_conditions; }
  /// Of each random effect the one condition whose numbers it moves, or `kSeveral`.
  [[nodiscard]] std::vector<int> conditions_of_effects() const;
  static constexpr int kSeveral = -1;
  [[nodiscard]] int angle_at() const noexcept { return num_parameters - 1; }
  /// That of random answers alone.
  [[nodiscard]] double lapse_limit() const noexcept {
    return guess_rate > 0.0 ? 1.0 - guess_rate : 0.5;
  }
  [[nodiscard]] double lapse_rate(const Eigen::VectorXd& parameters) const noexcept;
  /// ln density of the share of random answers, Beta(1, 20) but for a constant: its mean is
  /// a twentieth, and none is likeliest. Answers to comparisons that are all hard say next to
  /// nothing of lapses, and would else now and then have a flat curve taken for a steep one
  /// with many (a Beta prior for the same reason: Schuett, Harmeling, Macke and Wichmann 2016).
  [[nodiscard]] double log_prior(const Eigen::VectorXd& parameters) const noexcept;
  /// Its derivative by the lapse rate.
  [[nodiscard]] double log_prior_rise(double lapse_rate) const noexcept;
};

/// The likelihood of everybody's answers, integrated over how people differ, by Gauss and
/// Hermite's rule centred and scaled at each person's own mode (Liu and Pierce 1994; Pinheiro
/// and Bates 1995). The scale is that of the expected information, as in lme4, so that one node
/// is its Laplace approximation.
///
/// Given the random effects that several conditions share, those of one condition alone are
/// independent of those of another. Where the structure numbers the former last, as
/// `structure_of` does, the sum over all nodes is one over the shared nodes of products of sums
/// over each condition's own: the same number in a time that grows by the conditions, not to
/// their power.
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

  /// Whether the integral is one node's, Laplace's approximation.
  [[nodiscard]] bool is_laplace() const noexcept { return is_laplace_; }

  /// Each person's most likely numbers, given the parameters and the person's answers.
  [[nodiscard]] std::vector<Eigen::VectorXd> modes(const Eigen::VectorXd& parameters) const;

  /// Probability that answers of these curves, each person's own at the mode, lie as far from
  /// them as everybody's do; see `misfit_p_value`. What a mode follows a person's answers by is
  /// the trace of its hat matrix, less than one for each number of the person's own.
  [[nodiscard]] std::optional<double> misfit_p_value(const Eigen::VectorXd& parameters) const;

 private:
  static constexpr int kMostNumbers = 16;
  using Numbers = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMostNumbers, 1>;
  using Loadings = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostNumbers,
                                 kMostRandomEffects>;
  using Curvature = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMostRandomEffects,
                                  kMostRandomEffects>;
  /// What the parameters say, before anybody's own deviations.
  struct Population {
    Numbers median;
    Loadings loadings;
    double lapse_rate = 0.0;

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

  /// Derivatives of a person's log-likelihood.
  struct Score {
    Numbers numbers;
    double lapse_rate = 0.0;
  };

  /// A person's integral over nodes, without the determinant of the scale; what it adds to the
  /// scores is at `score`, where wanted: the parameters', and the lapse rate's behind them.
  [[nodiscard]] double log_integral(const HierarchicalPerson& person,
                                    const Population& population, const Mode& mode,
                                    const Curvature& upper, Eigen::VectorXd* score) const;
  [[nodiscard]] Population population_of(const Eigen::VectorXd& parameters) const;
  /// Log-likelihood of a person with these numbers.
  [[nodiscard]] double log_likelihood(const HierarchicalPerson& person, const Numbers& numbers,
                                      double lapse_rate) const noexcept;
  /// That of one condition; its derivatives are added to `score`.
  [[nodiscard]] double log_likelihood(const HierarchicalCell& cell, const Numbers& numbers,
                                      double lapse_rate, Score* score) const noexcept;
  [[nodiscard]] JointDerivatives joint_derivatives(const HierarchicalPerson& person,
                                                   const Population& population,
                                                   const RandomEffects& at) const;
  /// The answers of a person with these numbers, each level beside its probability of a yes.
  void add_fitted(const HierarchicalPerson& person, const Numbers& numbers, double lapse_rate,
                  std::vector<FittedAnswers>& answers) const;
  [[nodiscard]] Mode mode_of(const HierarchicalPerson& person, const Population& population,
                             const RandomEffects& start) const;

  HierarchicalStructure structure_;
  bool has_orders_ = false;  ///< In any condition.
  std::vector<HierarchicalPerson> people_;
  /// Random effects of one condition alone, by condition: the first, and how many. Those from
  /// `first_shared_` on are of several.
  struct OwnEffects {
    int first = 0, num = 0;
    GaussHermiteGrid grid;
  };
  std::vector<OwnEffects> own_;
  int first_shared_ = 0;
  GaussHermiteGrid shared_grid_;
  bool is_laplace_ = false;
  mutable std::vector<RandomEffects>
      last_;  ///< Modes found last: where the next search starts.
  /// Where `of_people` was asked last, and what it said: the searches ask again.
  mutable Eigen::VectorXd last_parameters_, last_values_;
};

}  // namespace jnd::analysis
