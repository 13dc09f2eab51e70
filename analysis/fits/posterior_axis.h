#pragma once

#include <cstddef>
#include <vector>

namespace jnd::analysis {

/// Evenly spaced values of one parameter, an odd number of them.
struct PosteriorAxis {
  double low = 0.0, high = 0.0;
  std::size_t size = 1;

  [[nodiscard]] double step() const noexcept {
    return size > 1 ? (high - low) / static_cast<double>(size - 1) : 0.0;
  }
  [[nodiscard]] double at(std::size_t i) const noexcept {
    return low + step() * static_cast<double>(i);
  }
  /// Simpson's weight; 1 for a parameter that is held.
  [[nodiscard]] double weight(std::size_t i) const noexcept {
    if (size == 1) return 1.0;
    const double share = i == 0 || i + 1 == size ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    return share * step() / 3.0;
  }
};

/// The stretch of the axis where the density matters, one step wider.
[[nodiscard]] PosteriorAxis narrowed(const PosteriorAxis& axis,
                                     const std::vector<double>& density);

/// The density's integral up to each value, by the cubic through four neighbours.
[[nodiscard]] std::vector<double> cumulated(const PosteriorAxis& axis,
                                            const std::vector<double>& density);

/// Integral up to `x`: Hermite's cubic with the density as slope. `sum` is `cumulated`.
[[nodiscard]] double cumulated_at(const PosteriorAxis& axis, const std::vector<double>& density,
                                  const std::vector<double>& sum, double x);

/// Where the integral reaches a probability; the density is that of a marginal, up to a factor,
/// on an axis of four values or more.
[[nodiscard]] double quantile_of(PosteriorAxis axis, const std::vector<double>& coarse,
                                 double probability);

/// Mass that would lie within `reach` beyond an end of the axis, over all that is on it, if the
/// density went on as it does there: by the exponential through the last two values, level
/// where it rises toward the end.
[[nodiscard]] double mass_beyond(const PosteriorAxis& axis, const std::vector<double>& density,
                                 bool at_high, double reach);

}  // namespace jnd::analysis
