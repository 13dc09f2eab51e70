#pragma once

#include "analysis/hierarchical/hierarchical_structure.h"

namespace jnd::analysis {

/// z at one level, and its derivatives by a and p.
struct Predictor {
  double z, by_slope, by_place;
};

/// `slope` is the result of `slope_of`.
[[nodiscard]] Predictor predictor(HierarchicalLink link, double slope, double place,
                                  double u) noexcept;

[[nodiscard]] double slope_of(HierarchicalLink link, double number) noexcept;

/// A level's two probabilities, f of a yes and g of a no, in the form that the likelihood
/// needs.
struct AnswerProbabilities {
  double log_yes, log_no;                    ///< ln f, ln g
  double by_z_yes, by_z_no;                  ///< d ln f / dz > 0, -d ln g / dz > 0
  double by_lapse_yes = 0, by_lapse_no = 0;  ///< d ln f / d lapse, d ln g / d lapse
};

/// Which values are wanted. The others may be 0.
struct AnswersWanted {
  bool of_yes = true, of_no = true;
  bool by_z = true, by_lapse = true;  ///< Whether the derivatives are wanted.
};

[[nodiscard]] AnswerProbabilities answer_probabilities(double z, double lapse_rate,
                                                       double guess_rate,
                                                       AnswersWanted wanted = {}) noexcept;

/// What one kind of answer to a level, yes or no, adds to the likelihood if answers scatter.
/// Their probability p is drawn from a beta distribution about the curve, so two of them
/// correlate by rho (Williams 1975). `count` of them multiply the likelihood by
///
///     p (p + phi) ... (p + (count - 1) phi),   phi = rho / (1 - rho),
///
/// which is p^count for phi = 0. Both kinds together are divided by 1 (1 + phi) ... (1 + (n -
/// 1) phi) over all n answers. That depends on phi alone: see `scatter_total`.
struct ScatteredSide {
  double value = 0.0;  ///< The logarithm of the product above.
  /// Its derivative as in `AnswerProbabilities`, over all `count` answers: > 0.
  double by_z = 0.0;
  double squares = 0.0;     ///< The sum of (dp/dz)^2 / factor^2.
  double by_lapse = 0.0;    ///< The derivative by the lapse rate.
  double by_scatter = 0.0;  ///< The derivative by phi.
};

/// `log_p`, `by_z` and `by_lapse` belong to one such answer. `phi` is > 0.
[[nodiscard]] ScatteredSide scattered_side(double count, double log_p, double by_z,
                                           double by_lapse, double phi);

/// Only the logarithm of the product.
[[nodiscard]] double scattered_value(double count, double log_p, double phi);

/// ln of 1 (1 + phi) ... (1 + (n - 1) phi), and its derivative by phi.
struct ScatterTotal {
  double value = 0.0, by_scatter = 0.0;
};
[[nodiscard]] ScatterTotal scatter_total(double num_answers, double phi);

}  // namespace jnd::analysis
