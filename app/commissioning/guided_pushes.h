#pragma once

#include <functional>
#include <vector>

#include "analysis/commissioning/delay_fit.h"
#include "app/commissioning/device_on_bench.h"
#include "core/random_stream.h"

namespace jnd::app {

/// Pushes to and fro along the device's x while it moves on, so that friction never turns.
class GuidedPushes {
 public:
  GuidedPushes(DeviceOnBench& started, const MeasuringPlan& plan);

  /// One way there and one back.
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
  core::RandomStream random_;  ///< Of where it goes, so that cogging averages out.
  int num_ways_ = 0;
  double push_n_ = 3.0;
  std::vector<analysis::PushedWindow> windows_;
};

}  // namespace jnd::app
