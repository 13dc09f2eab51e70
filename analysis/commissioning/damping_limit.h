#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// One way: a motion of the device during which a sweep acts at one of its inputs. Each input
/// is one axis of one contact point. The signals are periodic in the sweep and are stored as
/// the mean over whole sweeps.
struct SweptWay {
  int input = 0;  ///< The input at which the sweep acted.
  /// Rows are all inputs, and columns the ticks of a sweep. The velocity is read before the
  /// force of the same tick is sent.
  Eigen::MatrixXd commanded_n, velocity_m_per_s;
};

/// The damping up to which a haptic loop is stable on a device, derived from the device's
/// response.
struct DampingLimit {
  /// The commanded damping of the whole hand, in N s/m, at which an oscillation neither grows
  /// nor decays.
  Measured damping_n_s_per_m;
  double frequency_hz = 0.0;  ///< The frequency of that oscillation.
  /// Nothing grows at any damping up to the largest one that was asked for. The estimate is
  /// then that one.
  bool is_beyond = false;
  int num_ways = 0;  ///< The number of ways for each input.
};

/// Estimates the response G from the force commanded at each input to the velocity read at each
/// input, at the frequencies of the sweep. The limit is the smallest damping c for which 1 + c
/// G(w) S has a root on the unit circle. There an eigenvalue of G S is a negative real number,
/// and c is -1 divided by it (generalised Nyquist criterion, MacFarlane and Postlethwaite
/// 1977). S holds each input's share of the hand. So the device never has to become unstable.
///
/// `period_s` is that of the loop. `delay_s` is an approximate delay, as pushes give it. G is
/// smoothed over neighbouring frequencies as a ratio to a mass behind this delay. Dampings
/// above `largest_n_s_per_m` are not considered. The interval comes from leaving out one way
/// after the other. Throws `core::Error` if an input has fewer than 4 ways, or if no way is in
/// step with the sweep.
[[nodiscard]] DampingLimit damping_limit(const std::vector<SweptWay>& ways,
                                         const Eigen::VectorXd& share_ratio, double period_s,
                                         double delay_s, double largest_n_s_per_m);

}  // namespace jnd::analysis
