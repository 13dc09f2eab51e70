#include "device/check/velocity_lag.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace jnd::device {
namespace {

constexpr double kMostLag_s = 0.080, kLagStep_s = 0.001, kLateFrom_s = 0.015;
constexpr double kLeastMoved_m = 0.0005;

/// The values at any time, by straight lines between the measurements.
class Course {
 public:
  Course(const std::vector<double>& times_s, const std::vector<double>& values)
      : times_s_(times_s), values_(values) {}

  [[nodiscard]] double at(double time_s) const {
    const auto later = std::ranges::lower_bound(times_s_, time_s);
    if (later == times_s_.begin()) return values_.front();
    if (later == times_s_.end()) return values_.back();
    const auto i = static_cast<std::size_t>(later - times_s_.begin());
    const double part = (time_s - times_s_[i - 1]) / (times_s_[i] - times_s_[i - 1]);
    return values_[i - 1] + part * (values_[i] - values_[i - 1]);
  }

 private:
  const std::vector<double>& times_s_;
  const std::vector<double>& values_;
};

/// Root mean square of what is left of a difference without its mean.
double scatter(const std::vector<double>& differences) {
  double sum = 0.0, squares = 0.0;
  for (const double one : differences) sum += one;
  const auto num = static_cast<double>(differences.size());
  for (const double one : differences) squares += (one - sum / num) * (one - sum / num);
  return std::sqrt(squares / num);
}

}  // namespace

VelocityLag velocity_lag(std::span<const core::HapticState> states, std::size_t point,
                         int axis) {
  // Measurements that are new; the way by velocity from the first one on.
  std::vector<double> times_s, places_m, ways_m;
  for (const core::HapticState& state : states) {
    const double place_m = state.tip_position_m[point][axis];
    const double speed_m_per_s = state.tip_velocity_m_per_s[point][axis];
    if (!std::isfinite(place_m) || !std::isfinite(speed_m_per_s)) return {};
    const double time_s =
        1e-9 * static_cast<double>(state.device_time_ns - states.front().device_time_ns);
    if (!times_s.empty() && time_s <= times_s.back()) continue;
    const double step_s = times_s.empty() ? 0.0 : time_s - times_s.back();
    ways_m.push_back((ways_m.empty() ? 0.0 : ways_m.back()) + step_s * speed_m_per_s);
    times_s.push_back(time_s);
    places_m.push_back(place_m);
  }
  if (times_s.size() < 20 || times_s.back() < 2.0 * kMostLag_s) return {};
  const auto [low, high] = std::ranges::minmax(places_m);
  VelocityLag found{.moved_m = high - low};
  if (found.moved_m < kLeastMoved_m) return found;
  const Course way(times_s, ways_m);
  // The same measurements are compared at each lag.
  const double end_s = times_s.back() - kMostLag_s;
  double best_m = std::numeric_limits<double>::infinity(), at_once_m = 0.0;
  const auto num_lags = static_cast<int>(std::lround(kMostLag_s / kLagStep_s));
  for (int i = 0; i <= num_lags; ++i) {
    const double lag_s = kLagStep_s * i;
    std::vector<double> differences;
    for (std::size_t k = 0; k < times_s.size() && times_s[k] <= end_s; ++k) {
      differences.push_back(places_m[k] - way.at(times_s[k] + lag_s));
    }
    const double left_m = scatter(differences);
    if (i == 0) at_once_m = left_m;
    if (left_m < best_m) {
      best_m = left_m;
      found.lag_s = lag_s;
    }
  }
  std::vector<double> steps;
  for (std::size_t k = 0; k < times_s.size() && times_s[k] <= end_s; ++k) {
    steps.push_back(way.at(times_s[k] + kMostLag_s) - ways_m[k]);
  }
  found.shown_m = scatter(steps);
  constexpr double kAgrees = 0.1, kBetter = 0.5, kClear = 0.1;
  const bool is_late = found.lag_s > kLateFrom_s;
  const bool is_clear = at_once_m > kClear * found.shown_m && best_m < kBetter * at_once_m;
  found.is_known = best_m < kAgrees * found.moved_m && (!is_late || is_clear);
  found.is_too_late = found.is_known && is_late;
  return found;
}

void VelocityLagJudge::observe(std::span<const core::HapticState> states, std::size_t point) {
  for (int axis = 0; axis < 3; ++axis) {
    const VelocityLag lag = velocity_lag(states, point, axis);
    if (lag.is_known && lag.shown_m > clearest_.shown_m) clearest_ = lag;
  }
}

void VelocityLagJudge::judge(RuleJudge& judge) const {
  if (!clearest_.is_known) {
    return judge.skip(
        kSlowVelocity,
        "it moved too little or too evenly, or its velocities agree with the positions "
        "nowhere");
  }
  judge.judge(kSlowVelocity, !clearest_.is_too_late,
              fmt::format("{:.0f} ms behind, while it moved by {:.1f} mm",
                          1e3 * clearest_.lag_s, 1e3 * clearest_.moved_m));
}

}  // namespace jnd::device
