#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

/// A place on a curve that is told with its interval: a threshold, a PSE.
struct DrawnThreshold {
  double at = 0.5;  ///< Level of the curve between guess and lapse rate.
  double intensity = 0.0, proportion = 0.0;
  Interval ci95;  ///< Of the intensity.
};

/// Answers with the curve that is fitted to them, whatever model it is of.
struct DrawnCurve {
  std::string name;  ///< "participant 3"; "" for all rows.
  std::vector<CurvePoint> points;
  std::function<double(double intensity)> probability;  ///< Empty where there is no curve.
  std::vector<DrawnThreshold> thresholds;
};

struct CurveAxes {
  std::string intensity_name, answer_name;  ///< "Viscosity", "Proportion yes"
  bool logarithmic = false;
  double guess_rate = 0.0;  ///< Above 0, a line there.
};

/// Psychometric functions of up to six groups in one plot, of more in panels (at most 48):
/// answers as points whose area tells their number, with Wilson's 95 %, the fitted curve, and
/// its thresholds with their intervals. Throws `core::Error` where there is no answer to draw.
[[nodiscard]] Figure curve_figure(const std::vector<DrawnCurve>& curves, const CurveAxes& axes);

/// The same of fits by `fit_curve`. `names`: one a fit, "" for all rows. `answer_name`: the
/// column of the answers.
[[nodiscard]] Figure curve_figure(const std::vector<std::string>& names,
                                  const std::vector<CurveFit>& fits,
                                  const std::string& intensity_name,
                                  const std::string& answer_name);

}  // namespace jnd::analysis
