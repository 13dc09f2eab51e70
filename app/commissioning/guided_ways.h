#pragma once

#include <vector>

#include "analysis/commissioning/delay_fit.h"
#include "analysis/commissioning/force_fit.h"
#include "app/commissioning/device_on_bench.h"
#include "core/random_stream.h"

namespace jnd::app {

/// What the ways of one load are made with.
struct WaySetting {
  double load_kg = 0.0;
  int pose = 0;
};

/// Along a line, about a middle that is drawn anew for each, so that cogging averages out.
class GuidedWays {
 public:
  GuidedWays(DeviceOnBench& started, const MeasuringPlan& plan,
             const analysis::DelayFit& roughly);

  void go(const Eigen::Vector3d& middle_m, const Eigen::Vector3d& direction, double half_way_m,
          double speed_m_per_s, const WaySetting& setting);

  [[nodiscard]] const std::vector<analysis::GuidedWay>& ways() const noexcept { return ways_; }

 private:
  void one_way(const Eigen::Vector3d& end_m, const Eigen::Vector3d& along, double half_way_m,
               double speed_m_per_s, const WaySetting& setting);

  /// As it acted, at the time of each position.
  [[nodiscard]] std::vector<double> delayed(const std::vector<double>& force_n) const;

  DeviceOnBench& started_;
  double period_s_;
  GuideOrder order_;
  double delay_ticks_;
  core::RandomStream random_;
  std::vector<analysis::GuidedWay> ways_;
};

}  // namespace jnd::app
