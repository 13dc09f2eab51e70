#pragma once

namespace jnd::core {

/// Stevens' power law (1957): magnitude = k intensity^a, with 0^a = 0.
struct PowerFunction {
  double k = 1.0;  ///< Magnitude at intensity 1, > 0.
  double a = 1.0;  ///< Exponent.

  /// `intensity` >= 0.
  [[nodiscard]] double magnitude(double intensity) const noexcept;
  /// Returns the intensity that gives this magnitude, which is >= 0.
  [[nodiscard]] double intensity_at(double magnitude) const noexcept;
};

}  // namespace jnd::core
