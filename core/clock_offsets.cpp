#include "core/clock_offsets.h"

#include <algorithm>
#include <cmath>

namespace jnd::core {
namespace {

constexpr double kWindow_s = 60.0;
/// A larger step between two comparisons is a leap: no clock drifts this far in between, and no
/// message takes this long.
constexpr double kLeapOfOffset_s = 0.05;
/// A comparison that travels no distance still takes this long, because two clocks are read.
constexpr double kLeastRoundTrip_s = 20e-6;
/// A line through a shorter span is no better than its mean.
constexpr double kShortestLine_s = 10.0;

struct OffsetLine {
  double offset_s = 0.0, slope = 0.0;
};

OffsetLine line_at(double time_s, const std::vector<ClockOffset>& offsets, std::size_t first,
                   std::size_t end) {
  double sum = 0.0, sum_x = 0.0, sum_y = 0.0;
  double earliest_s = time_s, latest_s = time_s;
  const auto weight_of = [](const ClockOffset& one) {
    const double trip_s = std::max(one.round_trip_s, kLeastRoundTrip_s);
    return 1.0 / (trip_s * trip_s);
  };
  // The offsets may be huge, but their differences are small.
  const double base_s = offsets[first].offset_s;
  for (std::size_t i = first; i < end; ++i) {
    const ClockOffset& one = offsets[i];
    if (std::abs(one.time_s - time_s) > kWindow_s) continue;
    const double weight = weight_of(one);
    sum += weight;
    sum_x += weight * (one.time_s - time_s);
    sum_y += weight * (one.offset_s - base_s);
    earliest_s = std::min(earliest_s, one.time_s);
    latest_s = std::max(latest_s, one.time_s);
  }
  const double mean_x = sum_x / sum, mean_y = sum_y / sum;
  if (latest_s - earliest_s < kShortestLine_s) return {.offset_s = base_s + mean_y};
  double sum_xx = 0.0, sum_xy = 0.0;
  for (std::size_t i = first; i < end; ++i) {
    const ClockOffset& one = offsets[i];
    if (std::abs(one.time_s - time_s) > kWindow_s) continue;
    const double x = one.time_s - time_s - mean_x;
    sum_xx += weight_of(one) * x * x;
    sum_xy += weight_of(one) * x * (one.offset_s - base_s - mean_y);
  }
  const double slope = sum_xx > 0.0 ? sum_xy / sum_xx : 0.0;
  return {.offset_s = base_s + mean_y - slope * mean_x, .slope = slope};
}

}  // namespace

ClockCorrection::ClockCorrection(std::vector<ClockOffset> offsets) {
  std::erase_if(offsets, [](const ClockOffset& one) {
    return !std::isfinite(one.time_s) || !std::isfinite(one.offset_s) ||
           !std::isfinite(one.round_trip_s);
  });
  std::ranges::stable_sort(offsets, {}, &ClockOffset::time_s);
  for (std::size_t first = 0; first < offsets.size();) {
    std::size_t end = first + 1;
    while (end < offsets.size() &&
           std::abs(offsets[end].offset_s - offsets[end - 1].offset_s) <= kLeapOfOffset_s) {
      ++end;
    }
    for (std::size_t i = first; i < end; ++i) {
      const OffsetLine line = line_at(offsets[i].time_s, offsets, first, end);
      nodes_.push_back({.time_s = offsets[i].time_s,
                        .offset_s = line.offset_s,
                        .slope = line.slope,
                        .first = first,
                        .end = end});
    }
    first = end;
  }
}

double ClockCorrection::offset_s(double time_s) const noexcept {
  if (nodes_.empty()) return 0.0;
  const auto along = [time_s](const Node& node) {
    return node.offset_s + node.slope * (time_s - node.time_s);
  };
  const auto after = std::ranges::upper_bound(nodes_, time_s, {}, &Node::time_s);
  if (after == nodes_.begin()) return along(nodes_.front());
  const Node& before = *(after - 1);
  // Times before the first comparison after a leap belong to the clock before the leap.
  if (after == nodes_.end() || after->first != before.first) return along(before);
  const double span_s = after->time_s - before.time_s;
  if (!(span_s > 0.0)) return before.offset_s;
  const double share = (time_s - before.time_s) / span_s;
  return before.offset_s + share * (after->offset_s - before.offset_s);
}

}  // namespace jnd::core
