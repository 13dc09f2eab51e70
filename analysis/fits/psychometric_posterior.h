#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "analysis/fits/beta_prior.h"
#include "analysis/fits/posterior_axis.h"
#include "analysis/fits/psychometric_model.h"
#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// The posterior on a grid that has been narrowed to where it is not negligible. It yields the
/// distribution of any number that a curve has.
struct PosteriorGrid {
  using Axes =
      /// The axes are ln(1 / slope), the place of the pse, lapse rate and guess rate.
      std::array<PosteriorAxis, 4>;
  std::string reason;  ///< Why there is no posterior; "" if there is one.
  std::string priors;  ///< The priors in words.
  /// The range where the priors are not 0, and the range where the posterior is not negligible.
  Axes prior, axes;
  std::vector<double> density;  ///< The density up to a factor; the last axis varies fastest.
  std::array<std::vector<double>, 4> marginals;

  /// The median and the ends of the central 95 % of a number of the curve, from the masses of
  /// the grid's points. They are NaN if no point has the number.
  [[nodiscard]] std::array<double, 3> quantiles(
      const std::function<double(const PsychometricCurve&)>& value_of) const;
};

/// Computes the posterior with the priors of `posterior_on_grid`. A free guess rate has the
/// same prior as the lapse rate, `rates`.
[[nodiscard]] PosteriorGrid posterior_grid(const PsychometricLevels& levels,
                                           const FreeParameters& free,
                                           const BetaPrior& rates = kUsualRatePrior);

/// The Bayesian estimate on a grid that narrows to where the posterior is. The priors, which
/// the result describes in words, are: ln of the curve's spread is uniform from a quarter of
/// the smallest step between levels to four times their range. A free pse is uniform from half
/// a range below the levels to half a range above them, on the family's abscissa. A free lapse
/// rate has the prior `rates` below 0.5. The priors depend on the stimuli but not on the
/// answers. An estimate exists even if maximum likelihood has none. It then rests on the prior,
/// and `note` says so. An end of an interval is open if a wider prior of any parameter would
/// put more mass beyond it than the interval's own tail of 2.5 % (`mass_beyond`). Throws
/// nothing. The status is `degenerate` if there are fewer than two levels.
[[nodiscard]] PsychometricPosterior posterior_on_grid(const PsychometricLevels& levels,
                                                      const FreeParameters& free,
                                                      const BetaPrior& rates = kUsualRatePrior);

/// The medians with the rates' prior at each of `kOtherPriorWeights`.
[[nodiscard]] std::vector<PosteriorPriorEffect> posterior_prior_effects(
    const PsychometricLevels& levels, const FreeParameters& free, const BetaPrior& rates);

}  // namespace jnd::analysis
