#include "analysis/movement/strokes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/require.h"

namespace jnd::analysis {

StrokeMeter::StrokeMeter(const Parameters& parameters)
    : hysteresis_squared_m2_(parameters.hysteresis_m * parameters.hysteresis_m) {
  core::require_positive(parameters.hysteresis_m, "hysteresis_m");
}

void StrokeMeter::feed(const Eigen::Vector3d& position_m,
                       const Eigen::Vector3d& velocity_m_per_s, double duration_s) noexcept {
  const double x = position_m.x(), y = position_m.y();
  const double speed_squared = velocity_m_per_s.squaredNorm();
  if (!std::isfinite(x + y + position_m.z() + speed_squared + duration_s)) return;
  progress_.sum_height_m_s += position_m.z() * duration_s;
  progress_.duration_s += duration_s;
  if (!progress_.started) {
    progress_.started = true;
    progress_.from_x_m = progress_.farthest_x_m = x;
    progress_.from_y_m = progress_.farthest_y_m = y;
  }
  progress_.peak_since_farthest = std::max(progress_.peak_since_farthest, speed_squared);
  const double away_x = x - progress_.from_x_m, away_y = y - progress_.from_y_m;
  const double away_squared = away_x * away_x + away_y * away_y;
  if (away_squared > progress_.width_squared_m2) {
    progress_.width_squared_m2 = away_squared;
    progress_.farthest_x_m = x;
    progress_.farthest_y_m = y;
    progress_.peak_to_farthest =
        std::max(progress_.peak_to_farthest, progress_.peak_since_farthest);
    progress_.peak_since_farthest = 0.0;
    return;
  }
  // The way back from the farthest point along the line to it. Squares are compared, which
  // avoids a root.
  const double back =
      (progress_.farthest_x_m - x) * (progress_.farthest_x_m - progress_.from_x_m) +
      (progress_.farthest_y_m - y) * (progress_.farthest_y_m - progress_.from_y_m);
  if (back > 0.0 && back * back > hysteresis_squared_m2_ * progress_.width_squared_m2) {
    turn();
    const double to_x = x - progress_.from_x_m, to_y = y - progress_.from_y_m;
    progress_.width_squared_m2 = to_x * to_x + to_y * to_y;
    progress_.farthest_x_m = x;
    progress_.farthest_y_m = y;
  }
}

void StrokeMeter::turn() noexcept {
  Progress& my = progress_;
  const Half half = {.from_x_m = my.from_x_m,
                     .from_y_m = my.from_y_m,
                     .width_m = std::sqrt(my.width_squared_m2),
                     .peak = my.peak_to_farthest};
  const double open_m =
      std::hypot(my.farthest_x_m - my.there.from_x_m, my.farthest_y_m - my.there.from_y_m);
  if (my.is_back && is_closed(open_m, std::max(my.there.width_m, half.width_m))) {
    ++my.num_strokes;
    my.sum_width_m += my.there.width_m + half.width_m;
    my.sum_peak_m_per_s += std::sqrt(std::max(my.there.peak, half.peak));
    my.is_back = false;
  } else if (my.turned) {
    my.there = half;
    my.is_back = true;
  }
  my.turned = true;
  my.from_x_m = my.farthest_x_m;
  my.from_y_m = my.farthest_y_m;
  my.peak_to_farthest = std::exchange(my.peak_since_farthest, 0.0);
}

StrokeSummary StrokeMeter::finish() noexcept {
  StrokeSummary summary;
  summary.num_strokes = num_strokes();
  summary.duration_s = progress_.duration_s;
  if (summary.num_strokes > 0) {
    summary.stroke_width_m = progress_.sum_width_m / (2.0 * summary.num_strokes);
    summary.max_speed_m_per_s = progress_.sum_peak_m_per_s / summary.num_strokes;
  }
  if (progress_.duration_s > 0.0)
    summary.mean_height_m = progress_.sum_height_m_s / progress_.duration_s;
  progress_ = {};
  return summary;
}

}  // namespace jnd::analysis
