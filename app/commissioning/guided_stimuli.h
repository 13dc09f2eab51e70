#pragma once

#include "analysis/commissioning/force_fit.h"
#include "analysis/commissioning/noise_fit.h"
#include "app/commissioning/device_on_bench.h"

namespace jnd::app {

/// Renders stimuli on a device that the guide moves, to see how the device reacts. A fault of
/// the loop, which its guards latch when something swings, is an answer here. The device is
/// then armed again and held where it is.
class GuidedStimuli {
 public:
  GuidedStimuli(DeviceOnBench& started, analysis::NoiseFit noise,
                const analysis::ForceFit& force);

  /// Draws the device along its x axis through a fluid of this damping, and knocks it. Returns
  /// true if the loop had no fault.
  [[nodiscard]] bool is_drawn_through(double damping_n_s_per_m);

  /// Lets the device fall by 5 N onto a solid across its z axis, and shakes it at each point by
  /// a sweep. Returns true if the force does not swing further and further, and no guard of the
  /// loop ends it.
  [[nodiscard]] bool rests_on(double stiffness_n_per_m);

 private:
  [[nodiscard]] bool ended_well(core::Fault fault);
  void push(const Eigen::Vector3d& force_n);

  DeviceOnBench& started_;
  analysis::NoiseFit noise_;
  double friction_n_;  ///< As a commanded force.
  /// The force that holds up the weight which the motors do not carry.
  Eigen::Vector3d carrying_n_;
  Eigen::Vector3d home_m_;
};

}  // namespace jnd::app
