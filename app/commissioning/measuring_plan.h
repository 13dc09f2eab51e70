#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "core/safety/emergency_stop.h"
#include "core/safety/heartbeat.h"

namespace jnd::app {

/// What a laboratory has and wants for a commissioning.
struct MeasuringPlan {
  double rate_hz = 1000.0;
  /// In the workspace, touched by the first contact point: eight corners of a box unless the
  /// laboratory has others.
  std::vector<Eigen::Vector3d> marks_m;
  std::vector<double> loads_kg = {0.1, 0.2, 0.4};
  double load_uncertainty_ratio = 0.002;  ///< Standard uncertainty, over the loads.
  std::uint64_t seed = 1;                 ///< Of where ways begin.
  bool allow_no_realtime = false;
  core::EmergencyStop* emergency_stop = nullptr;
  /// Of the window in which somebody could press the stop; nullptr: it is at the terminal.
  const core::Heartbeat* watcher = nullptr;
  std::string operator_name;  ///< Who measures; "": not said.
};

/// What a measurement was made under, as its record keeps it.
struct MeasuringConditions {
  std::string operator_name;  ///< "": not said.
  std::string program_version;
  double rate_hz = 0.0;
  std::vector<double> loads_kg;
  double load_uncertainty_ratio = 0.0;
  std::uint64_t seed = 0;
  /// Of the force while it was measured.
  double max_force_per_point_n = 0.0, max_total_force_n = 0.0, max_slew_n_per_s = 0.0;
  double max_speed_m_per_s = 0.0;
};

}  // namespace jnd::app
