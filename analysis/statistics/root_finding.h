#pragma once

#include <functional>
#include <utility>

namespace jnd::analysis {

/// One end of a bracket, with the function's value there.
struct BracketEnd {
  double at = 0.0;
  double value = 0.0;
};

/// Narrows a bracket around the root of `function`, whose sign differs at the two given ends,
/// and returns the last bracket. It uses algorithm 748 of Alefeld, Potra and Shi (1995), until
/// `is_close(low, high)` holds or after `max_steps` evaluations. Not real time.
[[nodiscard]] std::pair<double, double> root_bracket(
    const std::function<double(double)>& function, BracketEnd low, BracketEnd high,
    const std::function<bool(double, double)>& is_close, int max_steps);

}  // namespace jnd::analysis
