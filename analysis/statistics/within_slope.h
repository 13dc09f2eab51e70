#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace jnd::analysis {

/// One answer: y at x, in a group that has its own level.
struct GroupedPoint {
  std::pair<std::int64_t, double> group;  ///< For example the session and the stimulus.
  double x = 0.0, y = 0.0;
};

/// The least-squares slope of y on x that all groups share, with an intercept for each group
/// (analysis of covariance). So differences between groups cannot seem to be an effect of x. It
/// is absent if x does not vary within any group.
[[nodiscard]] std::optional<double> within_slope(const std::vector<GroupedPoint>& points);

}  // namespace jnd::analysis
