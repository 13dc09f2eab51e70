#pragma once

#include "analysis/commissioning/force_fit.h"
#include "analysis/commissioning/noise_fit.h"
#include "app/commissioning/device_on_bench.h"

namespace jnd::app {

/// Renders stimuli on a device that the guide moves, to see what they do to it. A fault of the
/// loop, as its guards latch when something swings, is an answer here; the device is armed
/// again afterwards, held where it then is.
class GuidedStimuli {
 public:
  GuidedStimuli(DeviceOnBench& started, analysis::NoiseFit noise,
                const analysis::ForceFit& force);

  /// Drawn through a fluid of this damping along the device's x, and knocked: no fault of the
  /// loop.
  [[nodiscard]] bool is_drawn_through(double damping_n_s_per_m);

  /// Let fall by 5 N onto a solid that lies across the device's z, and shaken at each point by
  /// a sweep: the force there does not swing ever further, and no guard of the loop ends it.
  [[nodiscard]] bool rests_on(double stiffness_n_per_m);

 private:
  [[nodiscard]] bool ended_well(core::Fault fault);
  void push(const Eigen::Vector3d& force_n);

  DeviceOnBench& started_;
  analysis::NoiseFit noise_;
  double friction_n_;           ///< Commanded.
  Eigen::Vector3d carrying_n_;  ///< What holds up the weight that the motors do not carry.
  Eigen::Vector3d home_m_;
};

}  // namespace jnd::app
