#include "experiments/adaptive/level_scale.h"

#include <charconv>

#include "core/require.h"

namespace jnd::experiments {

double midpoint(LevelScale scale, double a, double b) noexcept {
  return from_scale(scale, 0.5 * (to_scale(scale, a) + to_scale(scale, b)));
}

double mean_level(LevelScale scale, const std::vector<double>& levels) noexcept {
  double sum = 0.0;
  for (const double level : levels) sum += to_scale(scale, level);
  return from_scale(scale, sum / static_cast<double>(levels.size()));
}

std::vector<double> equally_spaced(LevelScale scale, double lowest, double highest, int count) {
  core::require(count >= 2, "count", "two levels or more", count);
  require_ascending(scale, "highest", {lowest, highest});
  const double first = to_scale(scale, lowest);
  const double range = to_scale(scale, highest) - first;
  std::vector<double> levels = {lowest};
  for (int i = 1; i < count - 1; ++i) {
    levels.push_back(from_scale(scale, first + range * i / (count - 1)));
  }
  levels.push_back(highest);
  return levels;
}

std::string level_words(double level) {
  char digits[32];
  return {digits, std::to_chars(digits, digits + sizeof digits, level).ptr};
}

void require_level(LevelScale scale, std::string_view place, double level) {
  core::require(std::isfinite(level), place, "a finite level", level);
  core::require(scale == LevelScale::kLinear || level > 0.0, place,
                "a level > 0 in a logarithmic scale", level);
}

void require_ascending(LevelScale scale, std::string_view place,
                       const std::vector<double>& levels) {
  for (std::size_t i = 0; i < levels.size(); ++i) {
    require_level(scale, place, levels[i]);
    core::require(i == 0 || levels[i] > levels[i - 1], place, "levels in ascending order",
                  levels[i]);
  }
}

}  // namespace jnd::experiments
