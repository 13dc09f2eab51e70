#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace jnd::analysis {

/// One answer: y at x, within a group that has a level of its own.
struct GroupedPoint {
  std::pair<std::int64_t, double> group;  ///< Session and stimulus, say.
  double x = 0.0, y = 0.0;
};

/// The least-squares slope of y on x that all groups share, each with an intercept of its own
/// (analysis of covariance): what differs between groups cannot pass for an effect of x. Absent
/// where x is alike within every group.
[[nodiscard]] std::optional<double> within_slope(const std::vector<GroupedPoint>& points);

}  // namespace jnd::analysis
