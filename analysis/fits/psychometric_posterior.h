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

/// The posterior over a grid that has narrowed to where it is, for any number that a curve has.
struct PosteriorGrid {
  using Axes =
      std::array<PosteriorAxis, 4>;  ///< ln(1 / slope), place of the pse, lapse, guess.
  std::string reason;                ///< Why there is none; "" if there is.
  std::string priors;                ///< In words.
  Axes prior, axes;             ///< Where the priors are not 0, and where the posterior is.
  std::vector<double> density;  ///< Up to a factor, the last axis fastest.
  std::array<std::vector<double>, 4> marginals;

  /// Median, and the ends of the central 95 %, of a number of the curve: the grid's points by
  /// their mass. NaN where no point has the number.
  [[nodiscard]] std::array<double, 3> quantiles(
      const std::function<double(const PsychometricCurve&)>& value_of) const;
};

/// With the priors that `posterior_on_grid` says; a free guess rate has the lapse rate's,
/// `rates`.
[[nodiscard]] PosteriorGrid posterior_grid(const PsychometricLevels& levels,
                                           const FreeParameters& free,
                                           const BetaPrior& rates = kUsualRatePrior);

/// Bayesian estimate on a grid that narrows to where the posterior is. Priors, in words in the
/// result: ln of the curve's spread uniform from a quarter of the smallest step between levels
/// to four times their range; a free pse uniform from half a range below the levels to half a
/// range above, on the family's abscissa; a free lapse rate `rates`, below 0.5. They know
/// the stimuli and no result. A value exists even where maximum likelihood has none; it then
/// rests on the prior, which `note` says. An end of an interval is open where a wider prior, of
/// any parameter, would put more beyond it than the interval's own tail of 2.5 %
/// (`mass_beyond`). Throws nothing; `degenerate` without two levels.
[[nodiscard]] PsychometricPosterior posterior_on_grid(const PsychometricLevels& levels,
                                                      const FreeParameters& free,
                                                      const BetaPrior& rates = kUsualRatePrior);

/// The medians with the prior of the rates at `kOtherPriorWeights`.
[[nodiscard]] std::vector<PosteriorPriorEffect> posterior_prior_effects(
    const PsychometricLevels& levels, const FreeParameters& free, const BetaPrior& rates);

}  // namespace jnd::analysis
