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

/// Weber fractions as of `fit_psychometric` by least squares, the pse at the reference, of
/// answers that are drawn anew over and over: the grid that the search starts from is kept as
/// long as the levels stay the same.
class LeastSquaresFractions {
 public:
  /// Absent where there is none. Throws `core::Error` as `fit_psychometric`.
  [[nodiscard]] std::optional<double> of(const std::vector<AnswerCount>& rows,
                                         double reference);

 private:
  double reference_ = 0.0;
  std::vector<double> intensities_;
  std::optional<PsychometricSearch> search_;
};

}  // namespace jnd::analysis
