#include "analysis/statistics/root_finding.h"

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

namespace jnd::analysis {

std::pair<double, double> root_bracket(const std::function<double(double)>& function,
                                       BracketEnd low, BracketEnd high,
                                       const std::function<bool(double, double)>& is_close,
                                       int max_steps) {
  auto num_steps = static_cast<std::uintmax_t>(max_steps);
  return boost::math::tools::toms748_solve(function, low.at, high.at, low.value, high.value,
                                           is_close, num_steps);
}

}  // namespace jnd::analysis
