#pragma once

#include <vector>

#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// A stretch of motion along one line at nearly constant speed, while the device was pushed to
/// and fro along it: position [m] and commanded force [N] along it, one each tick.
struct PushedWindow {
  std::vector<double> position_m, commanded_n;
  int way = 0;  ///< Windows of the same way have the same cogging, and stand and fall together.
};

/// What the windows of one way come to by themselves.
struct PushedWay {
  double delay_s = 0.0, mass_per_gain_kg = 0.0;
};

/// How long a force takes to act, and how much it moves.
struct DelayFit {
  Measured delay_s;           ///< From a write until its force acts, as positions show it.
  Measured mass_per_gain_kg;  ///< Of the device, in newtons commanded: mass over gain.
  int num_ways = 0;
  std::vector<PushedWay> ways;  ///< Each by itself, to see how they scatter.
};

/// What the device makes of the pushes' fundamental, at angular frequency w, in each window,
///
///     position / force = exp(-i w delay) / (-w^2 mass + i w damping),
///
/// all in newtons commanded, by the Fourier sums of both at that frequency under a window of
/// von Hann, and the force standing from one write until the next. As the device keeps moving,
/// dry friction is a constant, and cogging has frequencies of its own. `push_ticks`: of one
/// push to and fro; `damping_per_gain_n_s_per_m`: as `fit_force` found it, over the gain; 0
/// where it is not known yet. Estimates over all windows, intervals by leaving out one after
/// the other (jackknife). Throws `core::Error` for fewer than five windows, for windows that
/// are no whole number of pushes, where nothing moves as it is
/// pushed.
[[nodiscard]] DelayFit fit_delay(const std::vector<PushedWindow>& windows, double period_s,
                                 int push_ticks, double damping_per_gain_n_s_per_m);

}  // namespace jnd::analysis
