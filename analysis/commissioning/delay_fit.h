#pragma once

#include <vector>

#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// A stretch of motion along one line at nearly constant speed, while the device was pushed
/// back and forth along it. It has one position [m] and one commanded force [N] along the line
/// for each tick.
struct PushedWindow {
  std::vector<double> position_m, commanded_n;
  /// Windows of the same way have the same cogging, so they are kept or left out together.
  int way = 0;
};

/// The estimates from the windows of one way alone.
struct PushedWay {
  double delay_s = 0.0, mass_per_gain_kg = 0.0;
};

/// How long a force takes to act, and how much it moves the device.
struct DelayFit {
  /// The time from a write until its force acts, as the positions show it.
  Measured delay_s;
  /// The mass of the device divided by its gain, so in terms of commanded newtons.
  Measured mass_per_gain_kg;
  int num_ways = 0;
  std::vector<PushedWay> ways;  ///< The estimates of each way, which show how they scatter.
};

/// Fits the response to the fundamental of the pushes, at the angular frequency w, in each
/// window:
///
///     position / force = exp(-i w delay) / (-w^2 mass + i w damping)
///
/// All quantities are in commanded newtons. The Fourier sums of position and force at that
/// frequency use a von Hann window. A force holds from one write until the next. The device
/// keeps moving, so dry friction is a constant, and cogging has other frequencies. `push_ticks`
/// is the length of one push back and forth. `damping_per_gain_n_s_per_m` is the damping that
/// `fit_force` found, divided by the gain; 0 if it is not yet known. Estimates use all windows,
/// and intervals leave out one way after the other (jackknife). Throws `core::Error` for fewer
/// than five ways, for windows that are not a whole number of pushes, and if the pushes do
/// not move the device.
[[nodiscard]] DelayFit fit_delay(const std::vector<PushedWindow>& windows, double period_s,
                                 int push_ticks, double damping_per_gain_n_s_per_m);

}  // namespace jnd::analysis
