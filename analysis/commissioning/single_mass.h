#pragma once

#include "analysis/commissioning/delay_fit.h"
#include "analysis/commissioning/force_fit.h"
#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// Whether a device is one: it moves after it is pushed, and is damped alike along its axes.
/// One whose tool or fingers give way seems to move before; then neither number of its delay is
/// one.
[[nodiscard]] bool is_single_mass(const DelayFit& delay, const ForceFit& force) noexcept;

/// A device as one mass, in newtons commanded: what was found, over the gain.
struct SingleMass {
  double mass_kg = 1.0;            ///< > 0.
  double damping_n_s_per_m = 0.0;  ///< >= 0.
  double delay_s = 0.0;            ///< From a write until its force acts, >= 0.
  double period_s = 0.001;         ///< Of the loop, > 0; a force stands for one.
};

/// The stiffness of a spring, rendered by a loop that reads a position and sends the force at
/// once, from which on the mass swings ever further: where an eigenvalue of a period's motion,
/// exactly integrated, leaves the unit circle. About damping / (delay + period / 2) (Gil et
/// al. 2004), without any help of dry friction or of what the loop does to keep it passive.
[[nodiscard]] double stiffness_limit_n_per_m(const SingleMass& device);

/// The same of a device that was measured, from the unfavourable ends of the intervals of its
/// damping, delay and mass to the favourable ones.
[[nodiscard]] Measured stiffness_limit(const DelayFit& delay, const ForceFit& force,
                                       double period_s);

}  // namespace jnd::analysis
