#pragma once

#include "analysis/commissioning/damping_limit.h"
#include "analysis/commissioning/measured.h"

namespace jnd::analysis {

/// The stimuli up to which a device was found stable without a hand. The mass and damping of a
/// hand make it more stable.
struct StabilityFit {
  double rate_hz = 0.0;  ///< The rate of the loop.
  /// The limit in the worst of the poses that could be distinguished.
  DampingLimit damping;
  /// The lower end of that limit as a fluid's viscosity, minus 3 %.
  double viscosity_pa_s = 0.0;
  double stiffness_n_per_m = 0.0;  ///< The stiffness of a solid.
  /// Whether it follows from the device's mass, damping and delay. Otherwise it follows from
  /// solids onto which the device was dropped.
  bool is_single_mass = true;
  /// The most viscous fluid, up to that limit, in which no guard of the loop ended the force
  /// while the device was drawn through it. Noise of the velocity is noise of the force, and
  /// more so in viscous fluids. It is 0 if a guard ended the force in every fluid.
  double quiet_viscosity_pa_s = 0.0;
};

}  // namespace jnd::analysis
