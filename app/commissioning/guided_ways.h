#pragma once

#include <vector>

#include "analysis/commissioning/delay_fit.h"
#include "analysis/commissioning/force_fit.h"
#include "app/commissioning/device_on_bench.h"
#include "core/random_stream.h"

namespace jnd::app {

/// The load and the pose of some ways.
struct WaySetting {
  double load_kg = 0.0;
  int pose = 0;
};

/// Moves the device along lines. The middle of each line is drawn anew, so that cogging
/// averages out.
class GuidedWays {
 public:
  /// `mass_per_gain_kg` is a rough value of the device, with which it is held firmly enough.
  GuidedWays(DeviceOnBench& started, const MeasuringPlan& plan, double mass_per_gain_kg);

  void go(const Eigen::Vector3d& middle_m, const Eigen::Vector3d& direction, double half_way_m,
          double speed_m_per_s, const WaySetting& setting);

  /// The ways that were recorded, if a force acts this long after its command.
  [[nodiscard]] std::vector<analysis::GuidedWay> ways(double delay_s) const;

 private:
  void one_way(const Eigen::Vector3d& end_m, const Eigen::Vector3d& along, double half_way_m,
               double speed_m_per_s, const WaySetting& setting);

  struct Recorded {
    Eigen::Vector3d along;
    std::vector<double> position_m, commanded_n;  ///< Along the way, one for each tick.
    WaySetting setting;
  };

  DeviceOnBench& started_;
  double period_s_;
  GuideOrder order_;
  core::RandomStream random_;
  std::vector<Recorded> ways_;
};

}  // namespace jnd::app
