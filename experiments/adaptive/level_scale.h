#pragma once

#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::experiments {

/// The scale in which levels are stepped and averaged.
enum class LevelScale {
  kLinear,       ///< The unit of the quantity.
  kLogarithmic,  ///< ln(level), with levels > 0. Equal steps are equal ratios.
};

[[nodiscard]] inline double to_scale(LevelScale scale, double level) noexcept {
  return scale == LevelScale::kLogarithmic ? std::log(level) : level;
}

[[nodiscard]] inline double from_scale(LevelScale scale, double value) noexcept {
  return scale == LevelScale::kLogarithmic ? std::exp(value) : value;
}

/// Returns the level in the middle of two: their mean, or their geometric mean.
[[nodiscard]] double midpoint(LevelScale scale, double a, double b) noexcept;

/// Returns the level whose value in the scale is the mean. `levels` is not empty.
[[nodiscard]] double mean_level(LevelScale scale, const std::vector<double>& levels) noexcept;

/// Returns `count` >= 2 levels from `lowest` to `highest`, both included, at equal steps in the
/// scale. Throws `Error` unless both are levels of the scale and `highest` is above `lowest`.
[[nodiscard]] std::vector<double> equally_spaced(LevelScale scale, double lowest,
                                                 double highest, int count);

/// Returns a level as messages spell it: "8", "0.5".
[[nodiscard]] std::string level_words(double level);

/// Throws `Error`, naming `place`, unless the level is finite and, in a logarithmic scale, > 0.
void require_level(LevelScale scale, std::string_view place, double level);

/// Throws `Error`, naming `place`, unless all are levels and each is above the one before.
void require_ascending(LevelScale scale, std::string_view place,
                       const std::vector<double>& levels);

}  // namespace jnd::experiments
