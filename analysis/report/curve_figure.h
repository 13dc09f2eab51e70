#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

/// A point on a curve that is reported with its interval, such as a threshold or a PSE.
struct DrawnThreshold {
  double at = 0.5;  ///< The level of the curve between guess and lapse rate.
  double intensity = 0.0, proportion = 0.0;
  Interval ci95;  ///< The interval of the intensity.
};

/// Answers with the curve that was fitted to them, of any model.
struct DrawnCurve {
  std::string name;  ///< For example "participant 3"; "" for all rows.
  std::vector<CurvePoint> points;
  std::function<double(double intensity)> probability;  ///< Empty if there is no curve.
  std::vector<DrawnThreshold> thresholds;
};

struct CurveAxes {
  std::string intensity_name, answer_name;  ///< For example "Viscosity" and "Proportion yes".
  bool logarithmic = false;
  double guess_rate = 0.0;  ///< If it is above 0, a line is drawn there.
};

/// Draws the psychometric functions of up to six groups in one plot, and of more groups in
/// panels (at most 48). Answers are points whose area shows their number, with Wilson's 95 %
/// interval. The fitted curve and its thresholds with their intervals are added. Throws
/// `core::Error` if there is no answer to draw.
[[nodiscard]] Figure curve_figure(const std::vector<DrawnCurve>& curves, const CurveAxes& axes);

/// The same for fits by `fit_curve`. `names` holds one name for each fit, "" for all rows.
/// `answer_name` is the column of the answers.
[[nodiscard]] Figure curve_figure(const std::vector<std::string>& names,
                                  const std::vector<CurveFit>& fits,
                                  const std::string& intensity_name,
                                  const std::string& answer_name);

}  // namespace jnd::analysis
