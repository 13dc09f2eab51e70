#pragma once

#include <optional>
#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "analysis/mixed/mixed_derived.h"
#include "analysis/mixed/mixed_fit.h"

namespace jnd::analysis {

/// What a picture shows of one cell of the factors.
struct CellCurve {
  std::string name;  ///< Of the cell; "" without factors.
  /// Answers of all groups, ascending; those of more than 24 different stimuli are of
  /// neighbours together.
  std::vector<CurvePoint> points;
  /// eta of the median group is offset + slope x, or of ln x on a logarithmic axis.
  double offset = 0.0, slope = 0.0;
  std::optional<double> pse;
  Interval pse_ci95;
};

/// The cells of a mixed model over its stimulus. Not real time.
[[nodiscard]] std::vector<CellCurve> cell_curves(const StimulusLines& lines,
                                                 const Design& design, const TrialTable& table,
                                                 const std::string& stimulus,
                                                 const MixedFit& fit,
                                                 const std::vector<DerivedQuantity>& derived);

}  // namespace jnd::analysis
