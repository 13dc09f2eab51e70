#include "core/sample_table.h"

#include <algorithm>

namespace jnd::core {
namespace {

void add_vector_names(std::vector<std::string>& names, const std::string& what,
                      const char* unit) {
  for (const char* axis : {"_x_", "_y_", "_z_"}) names.push_back(what + axis + unit);
}

}  // namespace

std::vector<std::string> sample_column_names(const SampleColumns& columns) {
  std::vector<std::string> names = {"tick"};
  if (columns.times) names.insert(names.end(), {"monotonic_s", "device_time_s"});
  for (const std::string_view point : kContactPointNames) {
    add_vector_names(names, std::string(point) + "_position", "m");
    add_vector_names(names, std::string(point) + "_velocity", "m_per_s");
    add_vector_names(names, std::string(point) + "_force", "n");
  }
  add_vector_names(names, "end_effector_position", "m");
  if (columns.joints) {
    for (const std::string_view joint : kJointNames) {
      names.push_back(std::string(joint) + "_position_rad");
    }
    for (const std::string_view joint : kJointNames) {
      names.push_back(std::string(joint) + "_torque_n_m");
    }
  }
  if ((columns.channels & kMeasuredForce) != 0) {
    for (const std::string_view point : kContactPointNames) {
      add_vector_names(names, std::string(point) + "_measured_force", "n");
    }
  }
  if ((columns.channels & kOrientation) != 0) {
    for (const char* part : {"w", "x", "y", "z"}) {
      names.push_back(std::string("end_effector_orientation_") + part);
    }
  }
  if ((columns.channels & kTorque) != 0) {
    add_vector_names(names, "end_effector_torque", "n_m");
  }
  if ((columns.channels & kGripper) != 0) names.emplace_back("gripper_m");
  if ((columns.channels & kButtons) != 0) names.emplace_back("buttons");
  for (const char* flag : {"attached_bits", "immersed_bits", "limited", "fault"}) {
    names.emplace_back(flag);
  }
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
  // Written so that NaN counts as something to be kept.
  const auto is_something = [](float value) { return !(value == 0.0F); };
  return std::ranges::any_of(sample.joint_position_rad, is_something) ||
         std::ranges::any_of(sample.joint_torque_n_m, is_something);
}

}  // namespace jnd::core
