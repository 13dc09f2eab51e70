#pragma once

#include <optional>
#include <vector>

#include "analysis/fits/psychometric_grid.h"
#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// Fits answers drawn anew on the levels of a fit, as bootstraps do: some ten microseconds
/// each, also with lapses and guesses. Where there can be several minima Newton's method starts
/// from the fitted curve, and from those of the lowest of a wide grid, between the fitted ends,
/// that are not far less likely than the minimum it leads to; from all of them where it leads
/// to none.
class PsychometricRefit {
 public:
  /// Keeps a reference to `search`; `levels` is read for its intensities and ends.
  PsychometricRefit(const PsychometricSearch& search, const PsychometricLevels& levels,
                    const PsychometricCurve& fitted);

  [[nodiscard]] PsychometricSearchResult find(const PsychometricLevels& redrawn) const;

 private:
  const PsychometricSearch& search_;
  PsychometricCurve fitted_, between_;  ///< The latter a little off the bounds of the rates.
  std::optional<PsychometricGrid> grid_;
  std::vector<double> logs_;
};

}  // namespace jnd::analysis
