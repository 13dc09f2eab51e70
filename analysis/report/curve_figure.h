#pragma once

#include <string>
#include <vector>

#include "analysis/fits/curve_fit.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

/// Psychometric functions of up to six groups in one plot, of more in panels (at most 48):
/// answers as points whose area tells their number, with Wilson's 95 %, the fitted curve, and
/// its thresholds with their likelihood-ratio intervals. `names`: one a fit, "" for all rows.
[[nodiscard]] Figure curve_figure(const std::vector<std::string>& names,
                                  const std::vector<CurveFit>& fits,
                                  const std::string& intensity_name,
                                  const std::string& answer_name);

}  // namespace jnd::analysis
