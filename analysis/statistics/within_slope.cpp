#include "analysis/statistics/within_slope.h"

#include <cmath>
#include <map>

namespace jnd::analysis {

std::optional<double> within_slope(const std::vector<GroupedPoint>& points) {
  struct Group {
    double sum_x = 0.0, sum_y = 0.0;
    int num = 0;
  };
  std::map<std::pair<std::int64_t, double>, Group> groups;
  for (const GroupedPoint& point : points) {
    Group& group = groups[point.group];
    group.sum_x += point.x;
    group.sum_y += point.y;
    ++group.num;
  }
  double squares = 0.0, products = 0.0;
  for (const GroupedPoint& point : points) {
    const Group& group = groups[point.group];
    const double dx = point.x - group.sum_x / group.num;
    squares += dx * dx;
    products += dx * (point.y - group.sum_y / group.num);
  }
  const double slope = products / squares;
  return squares > 0.0 && std::isfinite(slope) ? std::optional(slope) : std::nullopt;
}

}  // namespace jnd::analysis
