#pragma once

#include "core/media/force_map.h"
#include "core/media/medium.h"
#include "experiments/participants/laboratory.h"

namespace jnd::experiments {

/// A stroke of the simulated arm through a medium, calculated without a device.
struct CalculatedStroke {
  double max_speed_m_per_s = 0.0;  ///< Largest speed of the hand.
  /// Mean force of the medium divided by mean speed.
  double delivered_damping_n_s_per_m = 0.0;
};

/// The arm's reference moves to and fro as a sine with this amplitude (> 0) and largest speed
/// (> 0). A spring and a damper pull the hand's mass after it, against the medium, the
/// mechanical viscosity and the dry friction. The hand's speed V follows from harmonic balance
/// (Krylov and Bogoliubov 1943): a force F against the motion counts as the damping that takes
/// the same work out of a sine,
///
///   c(V) = 2 / (pi V) integral over half a stroke of F(V sin t) sin t dt,
///
/// which is 8/(3 pi) q V for drag q v^2 and 4 F / (pi V) for friction F. A viscous fluid is
/// delivered as its damping at any speed, and water as pi/4 q V. The hand is head on and deep
/// in the fluid. The calculation ignores the force limiter, ramps, the way to the first turning
/// point, lift, buoyancy and solid surfaces. Not real time.
[[nodiscard]] CalculatedStroke calculated_stroke(const Laboratory& laboratory,
                                                 double amplitude_m, double max_speed_m_per_s,
                                                 const core::MediumAmounts& medium,
                                                 const core::ForceMap* map = nullptr);

}  // namespace jnd::experiments
