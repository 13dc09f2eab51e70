#include "analysis/fits/posterior_axis.h"

#include <algorithm>
#include <cmath>

namespace jnd::analysis {
namespace {

/// The marginal on an axis that is sixteen times finer. Its logarithm is nearly a parabola, so
/// a cubic through four neighbouring logarithms keeps seven digits; a cubic through the density
/// itself would not.
std::vector<double> refined(PosteriorAxis& axis, const std::vector<double>& density) {
  constexpr std::size_t kFiner = 16;
  constexpr double kSteep = 30.0;
  std::vector<double> logs;
  for (const double value : density) logs.push_back(std::log(std::max(value, 1e-300)));
  const std::size_t last = density.size() - 1;
  std::vector<double> finer;
  for (std::size_t i = 0; i < last; ++i) {
    const std::size_t from = std::clamp<std::size_t>(i, 1, last - 2) - 1;
    // Next to an excluded value, such as a lapse rate of 0, a cubic would oscillate.
    const auto [least, most] =
        std::minmax_element(logs.begin() + static_cast<std::ptrdiff_t>(from),
                            logs.begin() + static_cast<std::ptrdiff_t>(from + 4));
    const bool smooth = *most - *least < kSteep;
    for (std::size_t part = 0; part < kFiner; ++part) {
      const double t = static_cast<double>(i - from) +
                       static_cast<double>(part) / static_cast<double>(kFiner);
      const double cubic = -logs[from] * (t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0 +
                           logs[from + 1] * t * (t - 2.0) * (t - 3.0) / 2.0 -
                           logs[from + 2] * t * (t - 1.0) * (t - 3.0) / 2.0 +
                           logs[from + 3] * t * (t - 1.0) * (t - 2.0) / 6.0;
      const double share = t - static_cast<double>(i - from);
      const double line = logs[i] + share * (logs[i + 1] - logs[i]);
      finer.push_back(std::exp(smooth ? cubic : line));
    }
  }
  finer.push_back(density[last]);
  axis.size = finer.size();
  return finer;
}

}  // namespace

PosteriorAxis narrowed(const PosteriorAxis& axis, const std::vector<double>& density) {
  constexpr double kNegligible = 1e-10;
  if (axis.size == 1) return axis;
  const double least = kNegligible * *std::max_element(density.begin(), density.end());
  std::size_t first = 0, last = axis.size - 1;
  while (density[first] < least) ++first;
  while (density[last] < least) --last;
  return {axis.at(first == 0 ? 0 : first - 1), axis.at(std::min(last + 1, axis.size - 1)),
          axis.size};
}

std::vector<double> cumulated(const PosteriorAxis& axis, const std::vector<double>& density) {
  const std::size_t n = density.size();
  std::vector<double> sum(n, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    double area = 0.0;
    if (i == 0) {
      area = 9.0 * density[0] + 19.0 * density[1] - 5.0 * density[2] + density[3];
    } else if (i + 2 == n) {
      area =
          9.0 * density[n - 1] + 19.0 * density[n - 2] - 5.0 * density[n - 3] + density[n - 4];
    } else {
      area = 13.0 * (density[i] + density[i + 1]) - density[i - 1] - density[i + 2];
    }
    sum[i + 1] = sum[i] + std::max(0.0, area) * axis.step() / 24.0;
  }
  return sum;
}

double quantile_of(PosteriorAxis axis, const std::vector<double>& coarse, double probability) {
  const std::vector<double> density = refined(axis, coarse);
  const std::vector<double> sum = cumulated(axis, density);
  const double wanted = probability * sum.back();
  std::size_t cell = 0;
  while (cell + 2 < sum.size() && sum[cell + 1] < wanted) ++cell;
  // Bisects Hermite's cubic through both ends with the density as its slope. The cubic rises.
  const double h = axis.step(), from = sum[cell], to = sum[cell + 1];
  double low = 0.0, high = 1.0;
  for (int halving = 0; halving < 60; ++halving) {
    const double t = 0.5 * (low + high), u = 1.0 - t;
    const double value = from * (1.0 + 2.0 * t) * u * u + to * t * t * (3.0 - 2.0 * t) +
                         h * t * u * (u * density[cell] - t * density[cell + 1]);
    (value < wanted ? low : high) = t;
  }
  return axis.at(cell) + h * 0.5 * (low + high);
}

double cumulated_at(const PosteriorAxis& axis, const std::vector<double>& density,
                    const std::vector<double>& sum, double x) {
  if (!(x > axis.low)) return 0.0;
  if (!(x < axis.high)) return sum.back();
  const double h = axis.step();
  const auto cell = std::min(static_cast<std::size_t>((x - axis.low) / h), sum.size() - 2);
  const double t = (x - axis.at(cell)) / h, u = 1.0 - t;
  return sum[cell] * (1.0 + 2.0 * t) * u * u + sum[cell + 1] * t * t * (3.0 - 2.0 * t) +
         h * t * u * (u * density[cell] - t * density[cell + 1]);
}

double mass_beyond(const PosteriorAxis& axis, const std::vector<double>& density, bool at_high,
                   double reach) {
  double all = 0.0;
  for (std::size_t i = 0; i < density.size(); ++i) all += density[i] * axis.weight(i);
  const double last = at_high ? density.back() : density.front();
  const double before = at_high ? density[density.size() - 2] : density[1];
  if (!(last > 0.0 && all > 0.0)) return 0.0;
  const double fall = before > last ? std::log(before / last) / axis.step() : 0.0;
  const double length = fall * reach > 1e-9 ? -std::expm1(-fall * reach) / fall : reach;
  return last / all * length;
}

}  // namespace jnd::analysis
