#pragma once

#include <functional>
#include <vector>

#include "analysis/commissioning/delay_fit.h"
#include "app/commissioning/device_on_bench.h"
#include "core/random_stream.h"

namespace jnd::app {

/// Pushes the device to and fro along its x axis while it moves on, so that friction never
/// changes its direction.
class GuidedPushes {
 public:
  GuidedPushes(DeviceOnBench& started, const MeasuringPlan& plan);

  /// Goes one way there and one way back in each round.
  void go(const Eigen::Vector3d& middle_m, int num_rounds,
          const std::function<void(int)>& tell);

  [[nodiscard]] analysis::DelayFit fit(double damping_per_gain) const;

 private:
  void take_windows(double sense);

  static constexpr double kPush_s = 0.030, kHalfWay_m = 0.14, kSpeed_m_per_s = 0.15,
                          kGathering_s = 0.6;

  DeviceOnBench& started_;
  double period_s_;
  int push_ticks_;
  /// Draws the places, so that cogging averages out.
  core::RandomStream random_;
  int num_ways_ = 0;
  double push_n_ = 3.0;
  std::vector<analysis::PushedWindow> windows_;
};

}  // namespace jnd::app
