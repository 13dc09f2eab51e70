#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::experiments {

/// In which scale levels are stepped and averaged.
enum class LevelScale {
  kLinear,       ///< In the unit of the quantity.
  kLogarithmic,  ///< In ln(level); levels must be > 0. Equal steps are equal ratios.
};

[[nodiscard]] inline double to_scale(LevelScale scale, double level) noexcept {
  return scale == LevelScale::kLogarithmic ? std::log(level) : level;
}

[[nodiscard]] inline double from_scale(LevelScale scale, double value) noexcept {
  return scale == LevelScale::kLogarithmic ? std::exp(value) : value;
}

/// The level in the middle of two: their mean, or their geometric mean.
[[nodiscard]] double midpoint(LevelScale scale, double a, double b) noexcept;

/// Mean in the scale, given back as a level; `levels` is not empty.
[[nodiscard]] double mean_level(LevelScale scale, const std::vector<double>& levels) noexcept;

/// `count` >= 2 levels from `lowest` to `highest`, both included, at equal steps in the scale.
/// Throws `Error` unless both are levels of the scale and `highest` is above `lowest`.
[[nodiscard]] std::vector<double> equally_spaced(LevelScale scale, double lowest,
                                                 double highest, int count);

/// A level as messages tell it: "8", "0.5".
[[nodiscard]] std::string level_words(double level);

/// Throws `Error`, naming `place`, unless a level is finite and, in a logarithmic scale, > 0.
void require_level(LevelScale scale, std::string_view place, double level);

/// Throws `Error`, naming `place`, unless all are levels and each is above the one before.
void require_ascending(LevelScale scale, std::string_view place,
                       const std::vector<double>& levels);

}  // namespace jnd::experiments
