#pragma once

#include <functional>
#include <vector>

#include "analysis/commissioning/damping_limit.h"
#include "app/commissioning/device_on_bench.h"
#include "core/random_stream.h"

namespace jnd::app {

/// Applies sweeps at one contact point after another along each axis, while the device moves on
/// along that axis, so that friction never changes its direction.
class GuidedSweeps {
 public:
  static constexpr double kSweep_n = 3.0;  ///< The amplitude.

  GuidedSweeps(DeviceOnBench& started, const MeasuringPlan& plan);

  /// Three axes for each of the device's points.
  [[nodiscard]] int num_inputs() const noexcept { return 3 * static_cast<int>(points_.size()); }
  [[nodiscard]] Eigen::VectorXd share_ratio() const;

  /// Goes one way there and one way back at each input, in each round.
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
  /// Draws the places, so that cogging averages out.
  core::RandomStream random_;
  std::vector<analysis::SweptWay> ways_;
};

}  // namespace jnd::app
