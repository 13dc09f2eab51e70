#include "core/safety/stillness_watch.h"

#include <algorithm>

#include "core/require.h"

namespace jnd::core {

StillnessWatch::StillnessWatch(const Parameters& parameters, double period_s)
    : parameters_(parameters), period_s_(period_s) {
  require_positive(parameters.max_still_s, "max_still_s");
  require_positive(parameters.fade_s, "fade_s");
  require_positive(parameters.confirm_s, "confirm_s");
  require_positive(parameters.return_s, "return_s");
  require_positive(parameters.max_way_m, "max_way_m");
  require_positive(parameters.memory_s, "memory_s");
  require_positive(period_s, "period_s");
}

void StillnessWatch::observe(const PointVectors& tip_position_m,
                             const PointVectors& tip_velocity_m_per_s,
                             const std::array<bool, kNumContactPoints>& attached,
                             std::uint8_t pushed_bits, double elapsed_s) noexcept {
  const double kept_ratio = std::max(0.0, 1.0 - elapsed_s / parameters_.memory_s);
  asks_to_move_ = false;
  for (int i = 0; i < kNumContactPoints; ++i) {
    Point& point = points_[static_cast<std::size_t>(i)];
    if (!attached[i]) {
      point = {};
      continue;
    }
    const bool stands_still = point.has_last && tip_position_m[i] == point.last_position_m;
    point.has_last = true;
    point.last_position_m = tip_position_m[i];
    const bool is_pushed = (pushed_bits >> i & 1) != 0;
    point.still_s = stands_still && is_pushed ? point.still_s + elapsed_s : 0.0;
    point.way_m =
        stands_still
            ? Eigen::Vector3d(kept_ratio * point.way_m + elapsed_s * tip_velocity_m_per_s[i])
            : Eigen::Vector3d::Zero();
    is_frozen_ |= point.way_m.norm() > parameters_.max_way_m;
    if (point.still_s > parameters_.max_still_s) {
      asks_to_move_ = true;
      take_force_away(point, elapsed_s);
    } else {
      point.without_force_s = 0.0;
      // By ticks that ran: back it comes no faster where some are missed.
      point.authority_ratio =
          std::min(1.0, point.authority_ratio + period_s_ / parameters_.return_s);
    }
  }
}

void StillnessWatch::take_force_away(Point& point, double elapsed_s) noexcept {
  point.authority_ratio = std::max(0.0, point.authority_ratio - elapsed_s / parameters_.fade_s);
  if (point.authority_ratio > 0.0) return;
  point.without_force_s += elapsed_s;
  is_frozen_ |= point.without_force_s > parameters_.confirm_s;
}

void StillnessWatch::reset() noexcept {
  asks_to_move_ = false;
  is_frozen_ = false;
  points_.fill({});
}

}  // namespace jnd::core
