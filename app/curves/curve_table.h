#pragma once

#include <string>
#include <vector>

#include "analysis/data/answer_file.h"
#include "analysis/fits/curve_fit.h"

namespace jnd::app {

/// The fits as CSV: a header, and a row for each threshold of each group. The columns of a
/// bootstrap and of a posterior follow the others if a fit has one.
[[nodiscard]] std::string curves_as_csv(const std::vector<analysis::AnswerGroup>& groups,
                                        const std::vector<analysis::CurveFit>& fits);

}  // namespace jnd::app
