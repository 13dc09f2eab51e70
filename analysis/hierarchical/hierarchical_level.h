#pragma once

#include "analysis/hierarchical/hierarchical_structure.h"

namespace jnd::analysis {

/// z at one level and its derivatives in a and p.
struct Predictor {
  double z, by_slope, by_place;
};

/// `slope`: of `slope_of`.
[[nodiscard]] Predictor predictor(HierarchicalLink link, double slope, double place,
                                  double u) noexcept;

[[nodiscard]] double slope_of(HierarchicalLink link, double number) noexcept;

/// A level's two probabilities, f of a yes and g of a no, as the likelihood needs them.
struct AnswerProbabilities {
  double log_yes, log_no;                    ///< ln f, ln g
  double by_z_yes, by_z_no;                  ///< d ln f / dz > 0, -d ln g / dz > 0
  double by_lapse_yes = 0, by_lapse_no = 0;  ///< d ln f / d lapse, d ln g / d lapse
};

/// What is wanted of them; the rest may be 0.
struct AnswersWanted {
  bool of_yes = true, of_no = true;
  bool by_z = true, by_lapse = true;  ///< The derivatives.
};

[[nodiscard]] AnswerProbabilities answer_probabilities(double z, double lapse_rate,
                                                       double guess_rate,
                                                       AnswersWanted wanted = {}) noexcept;

/// What one kind of answers to a level, yes or no, adds where answers scatter. Their
/// probability p is drawn from a beta distribution about the curve, so that two of them
/// correlate by rho (Williams 1975), and `count` of them multiply the likelihood by
///
///     p (p + phi) ... (p + (count - 1) phi),   phi = rho / (1 - rho),
///
/// of which p^count is left at phi = 0. What both kinds divide it by, 1 (1 + phi) ...
/// (1 + (n - 1) phi) over all n answers, hangs on phi alone: `scatter_total`.
struct ScatteredSide {
  double value = 0.0;       ///< ln of the above.
  double by_z = 0.0;        ///< As of `AnswerProbabilities`, of all `count`: > 0.
  double squares = 0.0;     ///< Sum of (dp/dz)^2 / factor^2.
  double by_lapse = 0.0;    ///< By the lapse rate.
  double by_scatter = 0.0;  ///< By phi.
};

/// `log_p`, `by_z`, `by_lapse`: of one such answer. `phi` > 0.
[[nodiscard]] ScatteredSide scattered_side(double count, double log_p, double by_z,
                                           double by_lapse, double phi);

/// The value alone.
[[nodiscard]] double scattered_value(double count, double log_p, double phi);

/// ln of 1 (1 + phi) ... (1 + (n - 1) phi), and its derivative by phi.
struct ScatterTotal {
  double value = 0.0, by_scatter = 0.0;
};
[[nodiscard]] ScatterTotal scatter_total(double num_answers, double phi);

}  // namespace jnd::analysis
