#pragma once

#include <functional>
#include <utility>

namespace jnd::analysis {

/// Where a continuous function changes its sign: an end of the bracket and what it is there.
struct BracketEnd {
  double at = 0.0;
  double value = 0.0;
};

/// The two ends of the last bracket of the root of `function`, which changes its sign between
/// the two given, by algorithm 748 of Alefeld, Potra and Shi (1995): until `is_close(low,
/// high)` or `max_steps` evaluations. Not real time.
[[nodiscard]] std::pair<double, double> root_bracket(
    const std::function<double(double)>& function, BracketEnd low, BracketEnd high,
    const std::function<bool(double, double)>& is_close, int max_steps);

}  // namespace jnd::analysis
