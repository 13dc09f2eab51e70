#pragma once

#include <functional>
#include <vector>

#include "analysis/commissioning/damping_limit.h"
#include "app/commissioning/device_on_bench.h"
#include "core/random_stream.h"

namespace jnd::app {

/// Sweeps at one contact point after the other, along each axis, while the device moves on
/// along that axis, so that friction never turns.
class GuidedSweeps {
 public:
  static constexpr double kSweep_n = 3.0;  ///< Amplitude.

  GuidedSweeps(DeviceOnBench& started, const MeasuringPlan& plan);

  /// Of the device's points, three axes each.
  [[nodiscard]] int num_inputs() const noexcept { return 3 * static_cast<int>(points_.size()); }
  [[nodiscard]] Eigen::VectorXd share_ratio() const;

  /// One way there and one back at each input.
  void go(const Eigen::Vector3d& middle_m, int num_rounds,
          const std::function<void(int input)>& tell);

  [[nodiscard]] const std::vector<analysis::SweptWay>& ways() const noexcept { return ways_; }

 private:
  void one_way(int input, const Eigen::Vector3d& end_m);

  static constexpr double kSweep_s = 0.128, kHalfWay_m = 0.14, kSpeed_m_per_s = 0.2,
                          kGathering_s = 0.4;

  DeviceOnBench& started_;
  double rate_hz_;
  std::vector<int> points_;
  int sweep_ticks_;
  core::RandomStream random_;  ///< Of where it goes, so that cogging averages out.
  std::vector<analysis::SweptWay> ways_;
};

}  // namespace jnd::app
