#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "analysis/fits/beta_prior.h"

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

/// Of the share of random answers, where nothing else is asked for: its mean is about a
/// twentieth, and none is likeliest. Answers to comparisons that are all hard say next to
/// nothing of lapses, and would else now and then have a flat curve taken for a steep one with
/// many (a Beta prior for the same reason: Schuett, Harmeling, Macke and Wichmann 2016).
inline constexpr BetaPrior kUsualLapsePrior = {1.0, 20.0};

/// Of either number of such a prior: more would hold the lapse rate whatever is answered.
inline constexpr double kLargestPriorParameter = 1e6;

/// Which numbers there are and how they vary. The parameters, in this order: a of each
/// condition, p of each if `has_places`, q of each if any has orders, then the loadings', then
/// an angle r if `has_scatter`, a spread tau if `has_own_lapses`, and, if `has_lapses`, an
/// angle v: a share sin^2 v of everybody's answers is random. Half of it is a yes, so that
///
///     P(yes) = lapse + (1 - 2 lapse) Phi(z),   lapse = sin^2 v / 2,
///
/// or, where answers are right ones of a forced choice, as many as chance makes right:
///
///     P(right) = guess + (1 - guess - lapse) Phi(z),   lapse = (1 - guess) sin^2 v.
///
/// With own lapses the share of a person's random answers is sin^2(v + tau b) instead, b
/// standard normal between people. With scatter the probability of a person's answers to one
/// level is itself drawn, from a beta distribution about the curve, so that two of them
/// correlate by rho = sin^2 r.
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
  int num_random_effects = 1;  ///< But for b of own lapses.
  int num_parameters = 2;
  bool has_own_lapses = false;  ///< Only with `has_lapses`.
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
  [[nodiscard]] int lapse_spread_at() const noexcept { return num_parameters - 2; }
  [[nodiscard]] int scatter_at() const noexcept {
    return num_parameters - 1 - (has_lapses ? 1 : 0) - (has_own_lapses ? 1 : 0);
  }
  /// The parameters in which the likelihood is even, so that 0, where a search may come to
  /// rest, is a maximum or a minimum: the spreads and the angle r, the angle v not among them.
  [[nodiscard]] std::vector<int> even_parameters() const;
  /// That of random answers alone.
  [[nodiscard]] double lapse_limit() const noexcept {
    return guess_rate > 0.0 ? 1.0 - guess_rate : 0.5;
  }
  /// With own lapses that of the median person, b = 0.
  [[nodiscard]] double lapse_rate(const Eigen::VectorXd& parameters) const noexcept;
  /// With own lapses the mean over people: they have the share of random answers
  /// sin^2 v + (1 - 2 sin^2 v) (1 - e^(-2 tau^2)) / 2.
  [[nodiscard]] double mean_lapse_rate(const Eigen::VectorXd& parameters) const noexcept;
  /// tau; 0 without own lapses.
  [[nodiscard]] double lapse_spread(const Eigen::VectorXd& parameters) const noexcept {
    return has_own_lapses ? parameters(lapse_spread_at()) : 0.0;
  }
  /// Correlation rho of two answers of one person to one level.
  [[nodiscard]] double correlation(const Eigen::VectorXd& parameters) const noexcept;
  /// rho / (1 - rho), phi of `scattered_side`; 0 without scatter.
  [[nodiscard]] double scatter(const Eigen::VectorXd& parameters) const noexcept;
  /// ln density of the share of random answers, of own ones its mean over people, but for a
  /// constant. A density of 0 at no lapses is taken as that of so few as nobody could tell.
  [[nodiscard]] double log_prior(const Eigen::VectorXd& parameters) const noexcept;
  /// Its derivative by the lapse rate, people being so far apart in theirs.
  [[nodiscard]] double log_prior_rise(double lapse_rate, double lapse_spread) const noexcept;
  /// Adds its derivatives by the parameters.
  void add_log_prior_rise(const Eigen::VectorXd& parameters, Eigen::VectorXd& gradient) const;
};

}  // namespace jnd::analysis
