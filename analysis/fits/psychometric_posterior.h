#pragma once

#include "analysis/fits/psychometric_model.h"
#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// Bayesian estimate on a grid that narrows to where the posterior is. Priors, in words in the
/// result: ln of the curve's spread uniform from a quarter of the smallest step between levels
/// to four times their range; a free pse uniform from half a range below the levels to half a
/// range above, on the family's abscissa; a free lapse rate Beta(1, 10) below 0.5. They know
/// the stimuli and no result. A value exists even where maximum likelihood has none; it then
/// rests on the prior, which `note` says. An end of an interval is open where a wider prior, of
/// any parameter, would put more beyond it than the interval's own tail of 2.5 %
/// (`mass_beyond`). Throws nothing; `degenerate` without two levels.
[[nodiscard]] PsychometricPosterior posterior_on_grid(const PsychometricLevels& levels,
                                                      const FreeParameters& free);

}  // namespace jnd::analysis
