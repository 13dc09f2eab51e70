#include "analysis/export/recording_columns.h"

#include <cmath>
#include <string_view>
#include <utility>

#include "core/sample_table.h"

namespace jnd::analysis {
namespace {

std::string meaning_of(std::string_view name) {
  if (name == "tick") return "Counted from 0 in the session";
  if (name == "monotonic_s") return "Only of real time; of the machine's monotonic clock";
  if (name == "device_time_s")
    return "Only of real time; of the measurement, the device's clock";
  if (name == "attached_bits") return "Bit i: point i holds the hand";
  if (name == "immersed_bits") return "Bit i: point i is in the medium";
  if (name == "limited") return "1: the force limiter changed the force";
  if (name == "fault") return "0: none";
  if (name == "gripper_m") return "Only from a device with a gripper; its opening";
  if (name == "buttons") return "Only from a device with buttons; bit i: button i is pressed";
  if (name.starts_with("end_effector_torque")) {
    return "Only from a device that tells of it; torque on the hand, workspace frame";
  }
  if (name.starts_with("end_effector_orientation")) {
    return "Only from a device that tells of it; unit quaternion to the workspace frame";
  }
  if (name.find("_measured_force_") != std::string_view::npos) {
    return "Only from a device with sensors of force; force on the hand that they measured";
  }
  if (name.ends_with("_rad")) return "Only from a device with joints; by its encoder";
  if (name.ends_with("_n_m")) return "Only from a device with joints; by its torque sensor";
  if (name.starts_with("end_effector")) {
    return "Of the arm that carries the fingers; workspace frame: x right, y away, z up";
  }
  return "Workspace frame: x right, y away, z up; force on the hand after every limit";
}

struct Unit {
  std::string_view ending;
  const char* unit;
  int decimals;
  bool of_joints = false;
};

/// The decimals follow the units in core/storage/sample_codec.h. The first match counts, so
/// "_n_m" stands before "_m".
constexpr Unit kUnits[] = {{"_n_m", "N m", 4, true},
                           {"_rad", "rad", 6, true},
                           {"_m_per_s", "m/s", 4},
                           {"_m", "m", 7},
                           {"_n", "N", 3},
                           {"_s", "s", 6},
                           {"tick", "tick", 0},
                           {"_orientation_w", "1", 6},
                           {"_orientation_x", "1", 6},
                           {"_orientation_y", "1", 6},
                           {"_orientation_z", "1", 6}};

}  // namespace

double RecordingColumn::step() const noexcept { return std::pow(10.0, -decimals); }

std::vector<RecordingColumn> recording_columns(const core::SampleColumns& which) {
  std::vector<RecordingColumn> columns;
  for (core::SampleColumn& sample_column : core::sample_columns(which)) {
    const std::string& name = sample_column.name;
    RecordingColumn column{.index = columns.size(), .meaning = meaning_of(name)};
    column.is_flags =
        name.ends_with("_bits") || name == "limited" || name == "fault" || name == "buttons";
    for (const Unit& unit : kUnits) {
      if (!name.ends_with(unit.ending)) continue;
      column.unit = unit.unit;
      column.decimals = unit.decimals;
      // From 8 rad on, single precision is coarser than the step, so every value is rounded.
      if (unit.of_joints) column.tolerance = 0.5;
      break;
    }
    column.column = std::move(sample_column);
    columns.push_back(std::move(column));
  }
  return columns;
}

double on_grid(double value, const RecordingColumn& column) {
  if (column.decimals == 0) return value;
  static constexpr double kSteps[] = {1.0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7};
  const double steps_per_unit = kSteps[column.decimals];
  const double steps = value * steps_per_unit;
  // This is also false for NaN.
  if (!(std::abs(steps) < 1e15) || std::abs(steps - std::round(steps)) > column.tolerance) {
    return value;
  }
  return std::round(steps) / steps_per_unit;
}

}  // namespace jnd::analysis
