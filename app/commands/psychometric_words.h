#pragma once

#include <string>
#include <vector>

#include "analysis/fits/curve_comparison.h"
#include "analysis/fits/curve_fit.h"

namespace jnd::app {

/// Prints fits, as people read them, to stdout. `names` are those of the groups; "" for all
/// rows.
void print_curves(const std::vector<std::string>& names,
                  const std::vector<analysis::CurveFit>& fits,
                  const std::vector<std::string>& notes);

void print_comparison(const analysis::CurveComparison& comparison);

}  // namespace jnd::app
