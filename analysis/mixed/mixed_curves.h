#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "analysis/mixed/mixed_derived.h"
#include "analysis/mixed/mixed_fit.h"

namespace jnd::analysis {

/// What a figure shows for one cell of the factors.
struct CellCurve {
  std::string name;  ///< The name of the cell; "" without factors.
  /// The answers of all groups by ascending stimulus. If there are more than 24 different
  /// stimuli, neighbours are pooled.
  std::vector<CurvePoint> points;
  /// eta of the median group is offset + slope x, with ln x in place of x on a logarithmic
  /// axis.
  double offset = 0.0, slope = 0.0;
  std::optional<double> pse;
  Interval pse_ci95;
};

/// The curves over the stimulus, one for each cell of a mixed model. Not real time.
[[nodiscard]] std::vector<CellCurve> cell_curves(const StimulusLines& lines,
                                                 const Design& design, const TrialTable& table,
                                                 const std::string& stimulus,
                                                 const MixedFit& fit,
                                                 const std::vector<DerivedQuantity>& derived);

}  // namespace jnd::analysis
