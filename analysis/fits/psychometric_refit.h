#pragma once

#include <optional>
#include <vector>

#include "analysis/fits/psychometric_grid.h"
#include "analysis/fits/psychometric_search.h"

namespace jnd::analysis {

/// Fits redrawn answers on the levels of a fit, as bootstraps do. It takes some ten
/// microseconds each, also with lapses and guesses. If there can be several minima, Newton's
/// method starts from the fitted curve and from the lowest curves of a wide grid between the
/// fitted ends. It skips those that are far less likely than the minimum found from the fitted
/// curve. If that start leads to no minimum it uses all of them.
class PsychometricRefit {
 public:
  /// Keeps a reference to `search`. Only the intensities and ends of `levels` are read.
  PsychometricRefit(const PsychometricSearch& search, const PsychometricLevels& levels,
                    const PsychometricCurve& fitted);

  [[nodiscard]] PsychometricSearchResult find(const PsychometricLevels& redrawn) const;

 private:
  const PsychometricSearch& search_;
  /// `between_` is the fitted curve with its rates a little off their bounds.
  PsychometricCurve fitted_, between_;
  std::optional<PsychometricGrid> grid_;
  std::vector<double> logs_;
};

/// Weber fractions by least squares, with the pse at the reference, of answers that are redrawn
/// many times. It keeps the grid from which the search starts as long as the levels stay the
/// same.
class LeastSquaresFractions {
 public:
  /// The fraction is absent if there is no optimum. Throws `core::Error` as `fit_psychometric`
  /// does.
  [[nodiscard]] std::optional<double> of(const std::vector<AnswerCount>& rows,
                                         double reference);

 private:
  double reference_ = 0.0;
  std::vector<double> intensities_;
  std::optional<PsychometricSearch> search_;
};

}  // namespace jnd::analysis
