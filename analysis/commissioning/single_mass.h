#pragma once

#include "analysis/commissioning/delay_fit.h"
#include "analysis/commissioning/force_fit.h"
#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// Whether a device is a single mass: it moves only after it is pushed, and its damping is the
/// same along its axes. A device whose tool or fingers yield seems to move before the push; its
/// delay then means nothing.
[[nodiscard]] bool is_single_mass(const DelayFit& delay, const ForceFit& force) noexcept;

/// A device as one mass, in commanded newtons: the fitted values divided by the gain.
struct SingleMass {
  double mass_kg = 1.0;            ///< > 0.
  double damping_n_s_per_m = 0.0;  ///< >= 0.
  double delay_s = 0.0;            ///< The time from a write until its force acts, >= 0.
  /// The period of the loop, > 0. A force holds for one period.
  double period_s = 0.001;
};

/// The stiffness of a rendered spring above which the mass oscillates more and more. The loop
/// reads a position and sends the force at once. The limit is where an eigenvalue of the motion
/// over one period, integrated exactly, leaves the unit circle. It is about damping / (delay +
/// period / 2) (Gil et al. 2004). It does not count on dry friction, or on what the loop does
/// to stay passive.
[[nodiscard]] double stiffness_limit_n_per_m(const SingleMass& device);

/// The limit of a measured device. Its interval goes from the unfavourable ends of the
/// intervals of damping, delay and mass to the favourable ones.
[[nodiscard]] Measured stiffness_limit(const DelayFit& delay, const ForceFit& force,
                                       double period_s);

}  // namespace jnd::analysis
