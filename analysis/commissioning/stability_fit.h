#pragma once

#include "analysis/commissioning/damping_limit.h"
#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// Up to which stimuli a device was found stable, nobody's hand in it: what a hand adds to its
/// mass and damping helps.
struct StabilityFit {
  double rate_hz = 0.0;            ///< Of the loop.
  DampingLimit damping;            ///< In the worst of the poses that could be told apart.
  double viscosity_pa_s = 0.0;     ///< The lower end of that as a fluid's, less 3 %.
  double stiffness_n_per_m = 0.0;  ///< Of a solid.
  /// By the device's mass, damping and delay; else by solids that it was let fall onto.
  bool is_single_mass = true;
  /// The thickest fluid up to that in which no guard of the loop ended the force when the
  /// device was drawn through it: noise of velocities is noise of the force, and the more so in
  /// thick fluids. 0: it did in every one.
  double quiet_viscosity_pa_s = 0.0;
};

}  // namespace jnd::analysis
