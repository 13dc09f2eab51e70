#include "analysis/movement/recorded_strokes.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/require.h"

namespace jnd::analysis {
namespace {

using core::require_not_negative;
using core::require_positive;

std::int64_t checked_pause_ticks(const HalfStrokeFinder::Parameters& parameters) {
  require_positive(parameters.period_s, "period_s");
  require_positive(parameters.hysteresis_m, "hysteresis_m");
  require_not_negative(parameters.rest_speed_m_per_s, "rest_speed_m_per_s");
  require_not_negative(parameters.shortest_pause_s, "shortest_pause_s");
  return std::llround(std::min(parameters.shortest_pause_s / parameters.period_s, 1e12));
}

}  // namespace

void HalfStrokeFinder::Sums::add(const Sums& other) noexcept {
  max_speed_m_per_s = std::max(max_speed_m_per_s, other.max_speed_m_per_s);
  path_m += other.path_m;
  pause_s += other.pause_s;
  energy_j += other.energy_j;
  sound = sound && other.sound;
}

HalfStrokeFinder::HalfStrokeFinder(const Parameters& parameters)
    : parameters_(parameters), shortest_pause_ticks_(checked_pause_ticks(parameters)) {}

std::optional<HalfStroke> HalfStrokeFinder::feed(const HandTick& hand) noexcept {
  Progress& my = progress_;
  if (!my.started) {
    my.started = true;
    my.from_tick = my.farthest_tick = hand.tick;
    my.from_x_m = my.farthest_x_m = hand.x_m;
    my.from_y_m = my.farthest_y_m = hand.y_m;
  }
  Sums& since = my.since_farthest;
  since.max_speed_m_per_s = std::max(since.max_speed_m_per_s, hand.speed_m_per_s);
  since.path_m += hand.speed_m_per_s * parameters_.period_s;
  since.energy_j += hand.dissipated_w * parameters_.period_s;
  since.sound = since.sound && hand.sound;
  count_rest(hand);
  const double away_x = hand.x_m - my.from_x_m, away_y = hand.y_m - my.from_y_m;
  const double away_squared = away_x * away_x + away_y * away_y;
  if (away_squared > my.width_squared_m2) {
    my.width_squared_m2 = away_squared;
    my.farthest_x_m = hand.x_m;
    my.farthest_y_m = hand.y_m;
    my.farthest_tick = hand.tick;
    my.to_farthest.add(std::exchange(since, {}));
    return std::nullopt;
  }
  // The way back from the farthest point along the line to it. Squares are compared, which
  // avoids a root.
  const double back = (my.farthest_x_m - hand.x_m) * (my.farthest_x_m - my.from_x_m) +
                      (my.farthest_y_m - hand.y_m) * (my.farthest_y_m - my.from_y_m);
  const double hysteresis_squared = parameters_.hysteresis_m * parameters_.hysteresis_m;
  if (!(back > 0.0 && back * back > hysteresis_squared * my.width_squared_m2)) {
    return std::nullopt;
  }
  return turn(hand);
}

/// A rest counts from its beginning once it has lasted long enough.
void HalfStrokeFinder::count_rest(const HandTick& hand) noexcept {
  Progress& my = progress_;
  if (!(hand.speed_m_per_s < parameters_.rest_speed_m_per_s)) {
    my.rest_ticks = 0;
    return;
  }
  ++my.rest_ticks;
  const std::int64_t counted = my.rest_ticks == std::max<std::int64_t>(1, shortest_pause_ticks_)
                                   ? my.rest_ticks
                                   : std::int64_t{my.rest_ticks > shortest_pause_ticks_};
  my.since_farthest.pause_s += static_cast<double>(counted) * parameters_.period_s;
}

HalfStroke HalfStrokeFinder::turn(const HandTick& hand) noexcept {
  Progress& my = progress_;
  const HalfStroke half = {.first_tick = my.from_tick,
                           .last_tick = my.farthest_tick,
                           .from_x_m = my.from_x_m,
                           .from_y_m = my.from_y_m,
                           .to_x_m = my.farthest_x_m,
                           .to_y_m = my.farthest_y_m,
                           .width_m = std::sqrt(my.width_squared_m2),
                           .max_speed_m_per_s = my.to_farthest.max_speed_m_per_s,
                           .path_m = my.to_farthest.path_m,
                           .pause_s = my.to_farthest.pause_s,
                           .energy_j = my.to_farthest.energy_j,
                           .sound = my.to_farthest.sound,
                           .whole = my.turned};
  my.turned = true;
  my.from_tick = my.farthest_tick;
  my.from_x_m = my.farthest_x_m;
  my.from_y_m = my.farthest_y_m;
  const double to_x = hand.x_m - my.from_x_m, to_y = hand.y_m - my.from_y_m;
  my.width_squared_m2 = to_x * to_x + to_y * to_y;
  my.farthest_tick = hand.tick;
  my.farthest_x_m = hand.x_m;
  my.farthest_y_m = hand.y_m;
  my.to_farthest = std::exchange(my.since_farthest, {});
  return half;
}

void StrokeSums::add(const HalfStroke& there, const HalfStroke& back,
                     double period_s) noexcept {
  ++num_strokes_;
  width_m_ += 0.5 * (there.width_m + back.width_m);
  max_speed_m_per_s_ += std::max(there.max_speed_m_per_s, back.max_speed_m_per_s);
  path_m_ += there.path_m + back.path_m;
  duration_s_ += static_cast<double>(there.num_ticks() + back.num_ticks()) * period_s;
  pause_s_ += there.pause_s + back.pause_s;
  energy_j_ += there.energy_j + back.energy_j;
}

void StrokeSums::add(const StrokeSums& other) noexcept {
  num_strokes_ += other.num_strokes_;
  width_m_ += other.width_m_;
  max_speed_m_per_s_ += other.max_speed_m_per_s_;
  path_m_ += other.path_m_;
  duration_s_ += other.duration_s_;
  pause_s_ += other.pause_s_;
  energy_j_ += other.energy_j_;
}

StrokeMeans StrokeSums::means() const noexcept {
  StrokeMeans means{.num_strokes = num_strokes_};
  if (num_strokes_ == 0) return means;
  const double n = num_strokes_;
  means.stroke_width_m = width_m_ / n;
  means.max_speed_m_per_s = max_speed_m_per_s_ / n;
  if (duration_s_ > 0.0) means.mean_speed_m_per_s = path_m_ / duration_s_;
  means.stroke_duration_s = duration_s_ / n;
  means.pause_s = pause_s_ / n;
  means.stroke_energy_j = energy_j_ / n;
  return means;
}

}  // namespace jnd::analysis
