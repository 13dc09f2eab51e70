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
  /// Marks in the workspace that the first contact point touches: the eight corners of a box,
  /// unless the laboratory has others.
  std::vector<Eigen::Vector3d> marks_m;
  std::vector<double> loads_kg = {0.1, 0.2, 0.4};
  double load_uncertainty_ratio = 0.002;  ///< The relative standard uncertainty of the loads.
  std::uint64_t seed = 1;                 ///< The seed of where ways begin.
  bool allow_no_realtime = false;
  core::EmergencyStop* emergency_stop = nullptr;
  /// The heartbeat of the window in which somebody could press the stop; nullptr if the stop is
  /// at the terminal.
  const core::Heartbeat* watcher = nullptr;
  std::string operator_name;  ///< The person who measures; "" if nobody said it.
};

/// The conditions of a measurement, as its record stores them.
struct MeasuringConditions {
  std::string operator_name;  ///< "" if nobody said it.
  std::string program_version;
  double rate_hz = 0.0;
  std::vector<double> loads_kg;
  double load_uncertainty_ratio = 0.0;
  std::uint64_t seed = 0;
  /// The limits of the force during the measurement.
  double max_force_per_point_n = 0.0, max_total_force_n = 0.0, max_slew_n_per_s = 0.0;
  double max_speed_m_per_s = 0.0;
};

}  // namespace jnd::app
