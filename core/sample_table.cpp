#include "core/sample_table.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace jnd::core {
namespace {

constexpr std::string_view kAxes[] = {"x", "y", "z"};

/// Adds the three columns of a vector, which belongs to a part or to an array without parts.
void add_vector(std::vector<SampleColumn>& columns, std::string_view part,
                const std::string& quantity, const std::string& unit) {
  const std::string front = part.empty() ? quantity : std::string(part) + "_" + quantity;
  for (const std::string_view axis : kAxes) {
    columns.push_back({.name = front + "_" + std::string(axis) + "_" + unit,
                       .array = quantity + "_" + unit,
                       .part = std::string(part),
                       .component = std::string(axis)});
  }
}

void add_joints(std::vector<SampleColumn>& columns, const std::string& quantity) {
  for (const std::string_view joint : kJointNames) {
    columns.push_back({.name = std::string(joint) + "_" + quantity,
                       .array = "joint_" + quantity,
                       .part = std::string(joint),
                       .component = ""});
  }
}

void add_alone(std::vector<SampleColumn>& columns, const char* name) {
  columns.push_back({.name = name, .array = name, .part = "", .component = ""});
}

}  // namespace

std::vector<SampleColumn> sample_columns(const SampleColumns& which) {
  std::vector<SampleColumn> columns;
  add_alone(columns, "tick");
  if (which.times) {
    add_alone(columns, "monotonic_s");
    add_alone(columns, "device_time_s");
  }
  for (const std::string_view point : kContactPointNames) {
    add_vector(columns, point, "position", "m");
    add_vector(columns, point, "velocity", "m_per_s");
    add_vector(columns, point, "force", "n");
  }
  add_vector(columns, "", "end_effector_position", "m");
  if (which.joints) {
    add_joints(columns, "position_rad");
    add_joints(columns, "torque_n_m");
  }
  if ((which.channels & kMeasuredForce) != 0) {
    for (const std::string_view point : kContactPointNames) {
      add_vector(columns, point, "measured_force", "n");
    }
  }
  if ((which.channels & kOrientation) != 0) {
    const std::string array = "end_effector_orientation";
    for (const char* part : {"w", "x", "y", "z"}) {
      columns.push_back(
          {.name = array + "_" + part, .array = array, .part = "", .component = part});
    }
  }
  if ((which.channels & kTorque) != 0) {
    add_vector(columns, "", "end_effector_torque", "n_m");
  }
  if ((which.channels & kGripper) != 0) add_alone(columns, "gripper_m");
  if ((which.channels & kButtons) != 0) add_alone(columns, "buttons");
  for (const char* flag : {"attached_bits", "immersed_bits", "limited", "fault"}) {
    add_alone(columns, flag);
  }
  return columns;
}

std::vector<std::string> sample_column_names(const SampleColumns& which) {
  std::vector<std::string> names;
  for (SampleColumn& column : sample_columns(which)) names.push_back(std::move(column.name));
  return names;
}

std::vector<double> sample_values(const Sample& sample, const SampleColumns& columns) {
  constexpr double kSPerNs = 1e-9;
  std::vector<double> values = {static_cast<double>(sample.tick)};
  if (columns.times) {
    values.push_back(kSPerNs * static_cast<double>(sample.monotonic_ns));
    values.push_back(kSPerNs * static_cast<double>(sample.device_time_ns));
  }
  const auto add = [&values](const auto& numbers) {
    values.insert(values.end(), numbers.begin(), numbers.end());
  };
  for (int point = 0; point < kNumContactPoints; ++point) {
    add(sample.tip_position_m[point]);
    add(sample.tip_velocity_m_per_s[point]);
    add(sample.tip_force_n[point]);
  }
  add(sample.end_effector_position_m);
  if (columns.joints) {
    add(sample.joint_position_rad);
    add(sample.joint_torque_n_m);
  }
  const DeviceChannels& channels = sample.channels;
  if ((columns.channels & kMeasuredForce) != 0) {
    for (const PlainVector& force_n : channels.force_n) add(force_n);
  }
  if ((columns.channels & kOrientation) != 0) add(channels.orientation_wxyz);
  if ((columns.channels & kTorque) != 0) add(channels.torque_n_m);
  if ((columns.channels & kGripper) != 0) values.push_back(channels.gripper_m);
  if ((columns.channels & kButtons) != 0) values.push_back(channels.buttons);
  for (const std::uint8_t flag :
       {sample.attached_bits, sample.immersed_bits, sample.limited, sample.fault}) {
    values.push_back(flag);
  }
  return values;
}

bool has_joints(const Sample& sample) noexcept {
  // The condition is written so that NaN counts as something to keep.
  const auto is_something = [](float value) { return !(value == 0.0F); };
  return std::ranges::any_of(sample.joint_position_rad, is_something) ||
         std::ranges::any_of(sample.joint_torque_n_m, is_something);
}

}  // namespace jnd::core
