#include "analysis/fits/profile_crossing.h"

#include <algorithm>
#include <cmath>

#include "analysis/statistics/root_finding.h"

namespace jnd::analysis {

std::optional<double> crossing(const std::function<double(double)>& excess, double from,
                               double first_step, double limit, double precision) {
  // Where answers are impossible the excess is infinite, with which a search for the root
  // cannot reckon.
  const auto bounded = [&excess](double at) {
    constexpr double kMost = 1e6;
    return std::min(excess(at), kMost);
  };
  double inside = from;
  double excess_inside = bounded(inside);
  for (double step = first_step; inside != limit; step *= 1.6) {
    const bool beyond = std::fabs(limit - inside) <= step;
    const double outside = beyond ? limit : inside + std::copysign(step, limit - inside);
    const double excess_outside = bounded(outside);
    if (excess_outside >= 0.0 && excess_inside < 0.0) {
      const auto close_enough = [precision](double a, double b) {
        return std::fabs(b - a) <= precision * std::max(std::fabs(a), std::fabs(b)) + 1e-300;
      };
      const bool rising = outside > inside;
      BracketEnd first{inside, excess_inside}, second{outside, excess_outside};
      if (!rising) std::swap(first, second);
      const auto [low, high] = root_bracket(bounded, first, second, close_enough, 200);
      return 0.5 * (low + high);
    }
    inside = outside;
    excess_inside = excess_outside;
  }
  return std::nullopt;
}

}  // namespace jnd::analysis
