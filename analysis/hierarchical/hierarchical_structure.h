#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "analysis/fits/beta_prior.h"

namespace jnd::analysis {

/// How a person's curve follows from the person's numbers. A person has three in each
/// condition: a slope number a, a place number p and, if either interval may hold the test, an
/// order number q. q moves the place to p + q o, with o as in `AnswerCount::order`. The
/// abscissa is u = ln(x / reference).
enum class HierarchicalLink {
  /// z = e^a (u - p), so people differ by factors. a is -ln ln(1 + w), and p is ln(pse /
  /// reference).
  kLogSlope,
  /// z = a u + p is linear, as in mixed-model software. a may come out below 0.
  kLinear,
};

/// One person's answers in one condition, with one entry for each level.
struct HierarchicalCell {
  int condition = 0;
  std::vector<double> log_ratio, num_yes, num_no;
  std::vector<double> order;  ///< The order of each level; see `AnswerCount::order`.
};
using HierarchicalPerson = std::vector<HierarchicalCell>;

/// The usual prior of the share of random answers. Its mean is about a twentieth, and no random
/// answers are most likely. If all comparisons are hard, answers tell almost nothing about
/// lapses. Without a prior a flat curve would sometimes be taken for a steep one with many
/// lapses (a Beta prior for the same reason: Schuett, Harmeling, Macke and Wichmann 2016).
inline constexpr BetaPrior kUsualLapsePrior = {1.0, 20.0};

/// The limit of both parameters of such a prior. Larger ones would fix the lapse rate whatever
/// the answers are.
inline constexpr double kLargestPriorParameter = 1e6;

/// Which numbers there are and how they vary. The parameters are, in this order: a of each
/// condition; p of each condition if `has_places`; q of each condition if any has orders; the
/// loadings' parameters; an angle r if `has_scatter`; a spread tau if `has_own_lapses`; and an
/// angle v if `has_lapses`. A share sin^2 v of everybody's answers is random. Half of these are
/// a yes, so that
///
///     P(yes) = lapse + (1 - 2 lapse) Phi(z),   lapse = sin^2 v / 2.
///
/// In a forced choice as many of them are right as chance makes right:
///
///     P(right) = guess + (1 - guess - lapse) Phi(z),   lapse = (1 - guess) sin^2 v.
///
/// With lapse rates of people's own, the share of a person's random answers is sin^2(v + tau
/// b), where b is standard normal over people. With scatter, the probability of a person's
/// answers to one level is drawn from a beta distribution about the curve, so two of them
/// correlate by rho = sin^2 r.
///
/// A person's numbers are those of the median person plus loadings times standard normal
/// numbers.
struct HierarchicalStructure {
  HierarchicalLink link = HierarchicalLink::kLogSlope;
  int num_conditions = 1;
  bool has_places = false;  ///< If false, every p is 0.
  /// For each condition, whether either interval may hold the test. If not, its q is 0.
  std::vector<bool> has_orders_in = {false};
  bool has_lapses = false;
  /// The lapse rate if it is no parameter, in [0, `lapse_limit`).
  double known_lapse_rate = 0.0;
  /// The guess rate, in [0, 1): 1 / m for a forced choice among m, and 0 otherwise.
  double guess_rate = 0.0;
  struct Loading {
    int number;         ///< The row: the number of the person that it moves.
    int random_effect;  ///< The column.
    int parameter;      ///< The index of its parameter. Several loadings may share one.
  };
  std::vector<Loading> loadings;
  int num_random_effects = 1;  ///< Does not count b of people's own lapse rates.
  int num_parameters = 2;
  bool has_own_lapses = false;  ///< Requires `has_lapses`.
  bool has_scatter = false;
  BetaPrior lapse_prior = kUsualLapsePrior;

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
  /// The index of the number, beside the slope, in which people differ.
  [[nodiscard]] int own_place_at(int condition) const noexcept {
    return has_orders_in[static_cast<std::size_t>(condition)] ? order_at(condition)
                                                              : place_at(condition);
  }
  /// The condition to which a number belongs.
  [[nodiscard]] int condition_of(int number) const noexcept { return number % num_conditions; }
  /// For each random effect, the one condition whose numbers it moves, or `kSeveral`.
  [[nodiscard]] std::vector<int> conditions_of_effects() const;
  static constexpr int kSeveral = -1;
  [[nodiscard]] int angle_at() const noexcept { return num_parameters - 1; }
  [[nodiscard]] int lapse_spread_at() const noexcept { return num_parameters - 2; }
  [[nodiscard]] int scatter_at() const noexcept {
    return num_parameters - 1 - (has_lapses ? 1 : 0) - (has_own_lapses ? 1 : 0);
  }
  /// The parameters in which the likelihood is even: the spreads and the angle r, but not the
  /// angle v. A search may come to rest at 0 of such a parameter, where the likelihood has a
  /// maximum or a minimum.
  [[nodiscard]] std::vector<int> even_parameters() const;
  /// The lapse rate if all answers are random.
  [[nodiscard]] double lapse_limit() const noexcept {
    return guess_rate > 0.0 ? 1.0 - guess_rate : 0.5;
  }
  /// The lapse rate. With lapse rates of people's own it is that of the median person, b = 0.
  [[nodiscard]] double lapse_rate(const Eigen::VectorXd& parameters) const noexcept;
  /// The mean lapse rate over people. With lapse rates of their own, their mean share of random
  /// answers is sin^2 v + (1 - 2 sin^2 v) (1 - e^(-2 tau^2)) / 2.
  [[nodiscard]] double mean_lapse_rate(const Eigen::VectorXd& parameters) const noexcept;
  /// The spread tau; 0 if people have no lapse rates of their own.
  [[nodiscard]] double lapse_spread(const Eigen::VectorXd& parameters) const noexcept {
    return has_own_lapses ? parameters(lapse_spread_at()) : 0.0;
  }
  /// The correlation rho of two answers of one person to one level.
  [[nodiscard]] double correlation(const Eigen::VectorXd& parameters) const noexcept;
  /// rho / (1 - rho), which is phi of `scattered_side`; 0 without scatter.
  [[nodiscard]] double scatter(const Eigen::VectorXd& parameters) const noexcept;
  /// The log density of the prior at the share of random answers, up to a constant. With lapse
  /// rates of people's own it is taken at the mean share. A share too small to notice replaces
  /// a share of 0, at which the density may be 0.
  [[nodiscard]] double log_prior(const Eigen::VectorXd& parameters) const noexcept;
  /// The derivative of the log prior by the lapse rate, for a given spread of lapse rates.
  [[nodiscard]] double log_prior_rise(double lapse_rate, double lapse_spread) const noexcept;
  /// Adds the derivatives of the log prior by the parameters.
  void add_log_prior_rise(const Eigen::VectorXd& parameters, Eigen::VectorXd& gradient) const;
};

}  // namespace jnd::analysis
