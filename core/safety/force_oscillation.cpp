#include "core/safety/force_oscillation.h"

#include <cmath>

#include "core/require.h"

namespace jnd::core {

ForceOscillation::ForceOscillation(const Parameters& parameters, double period_s)
    : swing_n_(parameters.swing_n), max_turns_(parameters.max_turns) {
  require_positive(parameters.swing_n, "swing_n");
  require_positive(parameters.window_s, "window_s");
  require(max_turns_ >= 2 && max_turns_ <= kMostTurns, "max_turns", "a number in [2, 32]",
          max_turns_);
  require_positive(period_s, "period_s");
  window_ticks_ = std::llround(parameters.window_s / period_s);
  reset();
}

void ForceOscillation::observe(const Eigen::Vector3d& force_n) noexcept {
  ++tick_;
  for (int i = 0; i < 3; ++i) {
    Axis& axis = axes_[i];
    const double value_n = force_n[i];
    const double ahead_n = axis.is_rising ? value_n - axis.extreme_n : axis.extreme_n - value_n;
    if (ahead_n >= 0.0) {
      axis.extreme_n = value_n;
    } else if (-ahead_n >= swing_n_) {
      axis.is_rising = !axis.is_rising;
      axis.extreme_n = value_n;
      const auto place = static_cast<std::size_t>(axis.next);
      // This is the turn that came `max_turns` before the present one.
      is_found_ |= tick_ - axis.turns[place] <= window_ticks_;
      const int most = axis.next + max_turns_ - 3 * max_turns_ / 4;
      const std::int64_t then_tick = axis.turns[static_cast<std::size_t>(most % max_turns_)];
      if (tick_ - then_tick <= window_ticks_) near_until_tick_ = then_tick + window_ticks_;
      axis.turns[place] = tick_;
      axis.next = (axis.next + 1) % max_turns_;
    }
  }
}

void ForceOscillation::reset() noexcept {
  is_found_ = false;
  near_until_tick_ = tick_ - 1;
  for (Axis& axis : axes_) {
    axis = Axis();
    axis.turns.fill(tick_ - window_ticks_ - 1);
  }
}

}  // namespace jnd::core
