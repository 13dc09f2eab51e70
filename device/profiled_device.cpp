#include "device/profiled_device.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/require.h"

namespace jnd::device {
namespace {

/// Whether the matrix is orthonormal and no reflection; false for NaN.
bool is_rotation(const Eigen::Matrix3d& matrix) {
  constexpr double kRounding = 1e-6;
  const Eigen::Matrix3d off = matrix * matrix.transpose() - Eigen::Matrix3d::Identity();
  return off.cwiseAbs().maxCoeff() <= kRounding && matrix.determinant() > 0.0 &&
         matrix.allFinite();
}

void require_profile(const ProfiledDevice::Parameters& parameters) {
  core::require(is_rotation(parameters.rotation), "rotation",
                "an orthonormal matrix without a mirror", parameters.rotation.determinant());
  core::require(parameters.offset_m.allFinite(), "offset_m", "finite numbers",
                parameters.offset_m.norm());
  core::require(parameters.max_force_per_point_n > 0.0, "max_force_per_point_n", "> 0",
                parameters.max_force_per_point_n);
  core::require(parameters.max_total_force_n > 0.0, "max_total_force_n", "> 0",
                parameters.max_total_force_n);
  core::require(parameters.max_slew_n_per_s > 0.0, "max_slew_n_per_s", "> 0",
                parameters.max_slew_n_per_s);
  core::require(parameters.max_speed_m_per_s > 0.0, "max_speed_m_per_s", "> 0",
                parameters.max_speed_m_per_s);
  core::require(parameters.workspace.half_width_x_m > 0.0, "workspace.half_width_x_m", "> 0",
                parameters.workspace.half_width_x_m);
  core::require(parameters.workspace.half_width_y_m > 0.0, "workspace.half_width_y_m", "> 0",
                parameters.workspace.half_width_y_m);
  core::require(parameters.workspace.half_width_z_m > 0.0, "workspace.half_width_z_m", "> 0",
                parameters.workspace.half_width_z_m);
  core::require_not_negative(parameters.own_mass_kg.value_or(0.0), "own_mass_kg");
  core::require_not_negative(parameters.own_damping_n_s_per_m.value_or(0.0),
                             "own_damping_n_s_per_m");
  core::require_not_negative(parameters.closed_loop_delay_s.value_or(0.0),
                             "closed_loop_delay_s");
}

core::PlainVector turned(const Eigen::Matrix3d& rotation,
                         const core::PlainVector& vector) noexcept {
  const Eigen::Vector3d result = rotation * Eigen::Vector3d(vector[0], vector[1], vector[2]);
  return {result.x(), result.y(), result.z()};
}

/// Returns how far a box around the robot's origin extends from the workspace's origin along
/// one axis.
double reach_m(const core::Workspace& robots, const Eigen::RowVector3d& row, double offset_m) {
  const std::array<double, 3> half_width_m = {robots.half_width_x_m, robots.half_width_y_m,
                                              robots.half_width_z_m};
  double sum_m = std::abs(offset_m);
  for (int axis = 0; axis < 3; ++axis) {
    // An axis without a part in the sum adds nothing, however wide the box is along it.
    if (row[axis] != 0.0) sum_m += std::abs(row[axis]) * half_width_m[axis];
  }
  return sum_m;
}

}  // namespace

ProfiledDevice::ProfiledDevice(std::unique_ptr<HapticDevice> inner,
                               const Parameters& parameters)
    : owned_(std::move(inner)),
      inner_(*owned_),
      parameters_(parameters),
      turn_(parameters.rotation) {
  require_profile(parameters_);
}

ProfiledDevice::ProfiledDevice(HapticDevice& inner, const Parameters& parameters)
    : inner_(inner), parameters_(parameters), turn_(parameters.rotation) {
  require_profile(parameters_);
}

DeviceCapabilities ProfiledDevice::capabilities() const noexcept {
  DeviceCapabilities can = inner_.capabilities();
  const Parameters& most = parameters_;
  can.max_force_per_point_n = std::min(can.max_force_per_point_n, most.max_force_per_point_n);
  can.max_total_force_n = std::min(can.max_total_force_n, most.max_total_force_n);
  can.max_slew_n_per_s = std::min(can.max_slew_n_per_s, most.max_slew_n_per_s);
  can.max_speed_m_per_s = std::min(can.max_speed_m_per_s, most.max_speed_m_per_s);
  const auto narrower = [&](double half_width_m, int axis) {
    return std::min(half_width_m,
                    reach_m(can.workspace, most.rotation.row(axis), most.offset_m[axis]));
  };
  can.workspace = {narrower(most.workspace.half_width_x_m, 0),
                   narrower(most.workspace.half_width_y_m, 1),
                   narrower(most.workspace.half_width_z_m, 2)};
  can.own_mass_kg = most.own_mass_kg.value_or(can.own_mass_kg);
  can.own_damping_n_s_per_m = most.own_damping_n_s_per_m.value_or(can.own_damping_n_s_per_m);
  can.closed_loop_delay_s = most.closed_loop_delay_s.value_or(can.closed_loop_delay_s);
  return can;
}

bool ProfiledDevice::read(core::HapticState& state) noexcept {
  if (!inner_.read(state)) return false;
  const Eigen::Matrix3d& rotation = parameters_.rotation;
  const DeviceCapabilities can = inner_.capabilities();
  core::DeviceChannels& channels = state.channels;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (!can.has_point(i)) continue;
    const auto point = static_cast<std::size_t>(i);
    state.tip_position_m[point] =
        (rotation * state.tip_position_m[point] + parameters_.offset_m).eval();
    state.tip_velocity_m_per_s[point] = (rotation * state.tip_velocity_m_per_s[point]).eval();
    state.acted_n[point] = (rotation * state.acted_n[point]).eval();
    channels.force_n[point] = turned(rotation, channels.force_n[point]);
  }
  if (state.end_effector_position_m != Eigen::Vector3d::Zero()) {
    state.end_effector_position_m =
        (rotation * state.end_effector_position_m + parameters_.offset_m).eval();
  }
  channels.torque_n_m = turned(rotation, channels.torque_n_m);
  if (channels.has(core::kOrientation)) {
    const auto& wxyz = channels.orientation_wxyz;
    const Eigen::Quaterniond seen =
        turn_ * Eigen::Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]);
    channels.orientation_wxyz = {seen.w(), seen.x(), seen.y(), seen.z()};
  }
  return true;
}

bool ProfiledDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  core::PointVectors robots_n = core::zero_vectors();
  for (std::size_t point = 0; point < robots_n.size(); ++point) {
    robots_n[point] = parameters_.rotation.transpose() * force_on_hand_n[point];
  }
  return inner_.write(robots_n);
}

}  // namespace jnd::device
