#pragma once

#include <Eigen/Core>
#include <vector>

#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// One way of a device that moves on while a sweep acts at one of its inputs, of which each is
/// one axis of one contact point; what is periodic in the sweep, as its mean over whole sweeps.
struct SweptWay {
  int input = 0;  ///< At which the sweep acted.
  /// Rows: every input. Columns: ticks of a sweep, read before the force of the same tick was
  /// sent.
  Eigen::MatrixXd commanded_n, velocity_m_per_s;
};

/// Up to which damping a haptic loop is stable on a device, as its own response tells it.
struct DampingLimit {
  /// Commanded, of the whole hand, in N s/m, at which an oscillation neither grows nor decays.
  Measured damping_n_s_per_m;
  double frequency_hz = 0.0;  ///< Of that oscillation.
  /// No damping up to the largest that was asked for lets anything grow; the estimate is that.
  bool is_beyond = false;
  int num_ways = 0;  ///< Of each input.
};

/// The response G from what is commanded at each input to the velocity that is read at each
/// one, at the frequencies of the sweep, and from it the smallest damping c for which
/// 1 + c G(w) S has a root on the unit circle: an eigenvalue of G S is a negative real number
/// there, and c is -1 over it (generalised Nyquist criterion, MacFarlane and Postlethwaite
/// 1977). S is each input's share of the hand. So nothing has to become unstable to find out
/// when it would.
///
/// `period_s` of the loop. `delay_s`: roughly, as told by pushes; G is smoothed over
/// neighbouring frequencies as a ratio to a mass behind that delay. `largest_n_s_per_m`: beyond
/// it nobody asks. The interval is by leaving out one way after the other. Throws
/// `core::Error`: fewer than 4 ways of an input, or none at all that are in step with the
/// sweep.
[[nodiscard]] DampingLimit damping_limit(const std::vector<SweptWay>& ways,
                                         const Eigen::VectorXd& share_ratio, double period_s,
                                         double delay_s, double largest_n_s_per_m);

}  // namespace jnd::analysis
