#pragma once

#include <cstddef>
#include <vector>

namespace jnd::analysis {

/// An odd number of evenly spaced values of one parameter.
struct PosteriorAxis {
  double low = 0.0, high = 0.0;
  std::size_t size = 1;

  [[nodiscard]] double step() const noexcept {
    return size > 1 ? (high - low) / static_cast<double>(size - 1) : 0.0;
  }
  [[nodiscard]] double at(std::size_t i) const noexcept {
    return low + step() * static_cast<double>(i);
  }
  /// The weight of Simpson's rule. It is 1 for a parameter that is held.
  [[nodiscard]] double weight(std::size_t i) const noexcept {
    if (size == 1) return 1.0;
    const double share = i == 0 || i + 1 == size ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
    return share * step() / 3.0;
  }
};

/// The stretch of the axis where the density is not negligible, widened by one step on either
/// side.
[[nodiscard]] PosteriorAxis narrowed(const PosteriorAxis& axis,
                                     const std::vector<double>& density);

/// The integral of the density up to each value, from the cubic through four neighbours.
[[nodiscard]] std::vector<double> cumulated(const PosteriorAxis& axis,
                                            const std::vector<double>& density);

/// The integral up to `x`, from Hermite's cubic with the density as its slope. `sum` is the
/// result of `cumulated`.
[[nodiscard]] double cumulated_at(const PosteriorAxis& axis, const std::vector<double>& density,
                                  const std::vector<double>& sum, double x);

/// The place where the integral reaches a share of the whole. The density is a marginal up to a
/// factor, on an axis of at least four values.
[[nodiscard]] double quantile_of(PosteriorAxis axis, const std::vector<double>& coarse,
                                 double probability);

/// The mass that would lie within `reach` beyond an end of the axis if the density continued
/// there, divided by the mass on the axis. The continuation is the exponential through the last
/// two values, or constant if the density rises toward the end.
[[nodiscard]] double mass_beyond(const PosteriorAxis& axis, const std::vector<double>& density,
                                 bool at_high, double reach);

}  // namespace jnd::analysis
