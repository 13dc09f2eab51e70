#include "device/exoskeleton/characterization.h"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "device/exoskeleton/kinematics.h"

namespace jnd::device {
namespace {

constexpr std::array kPoses = {FingerPose::k0, FingerPose::k90, FingerPose::k180,
                               FingerPose::k270, FingerPose::kInclined};
/// No hand exerts, and no finger resists, a larger force.
constexpr double kMostForceN = 100.0;
constexpr std::uint8_t kEveryBit = (1 << core::kNumContactPoints) - 1;
constexpr std::array kWeights_kg = {0.050, 0.100, 0.150, 0.200, 0.250};

/// Returns the mean relative error, without the lightest weight.
double mean_relative_error(const SensorAccuracy& sensor) {
  double sum = 0.0;
  for (std::size_t i = 1; i < sensor.readings.size(); ++i) {
    const TorqueReading& reading = sensor.readings[i];
    const auto joint = static_cast<std::size_t>(sensor.joint);
    sum += std::abs(reading.measured_n_m[joint] / reading.expected_n_m[joint] - 1.0);
  }
  return sum / static_cast<double>(sensor.readings.size() - 1);
}

/// Returns the torques of all motors minus the links' weight, as forces of the tips on the
/// hand.
Eigen::Vector3d force_of_fingers_n(const ExoskeletonKinematics& kinematics,
                                   const core::Sample& sample) {
  const JointVector gravity_n_m = kinematics.gravity_torque_n_m();
  Eigen::Vector3d force_n = Eigen::Vector3d::Zero();
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    Eigen::Vector3d torque_n_m;
    for (int joint = 0; joint < core::kNumJointsPerFinger; ++joint) {
      const int index = core::finger_joint(point, joint);
      torque_n_m[joint] =
          static_cast<double>(sample.joint_torque_n_m[index]) - gravity_n_m[index];
    }
    force_n += kinematics.finger_jacobian(point).transpose().inverse() * torque_n_m;
  }
  return force_n;
}

JointVector positions_of(const core::Sample& sample) {
  JointVector position_rad;
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    position_rad[joint] = static_cast<double>(sample.joint_position_rad[joint]);
  }
  return position_rad;
}

}  // namespace

double share_along_motion(FingerPose pose) noexcept {
  return pose == FingerPose::kInclined ? 0.5 * std::numbers::sqrt2 : 1.0;
}

MeanAndSpread mean_and_spread(const std::vector<double>& values) {
  MeanAndSpread result;
  const auto count = static_cast<double>(values.size());
  for (const double value : values) result.mean += value / count;
  double squares = 0.0;
  for (const double value : values) squares += (value - result.mean) * (value - result.mean);
  if (values.size() > 1) result.sd = std::sqrt(squares / (count - 1.0));
  return result;
}

FingerCharacter characterize_finger(FingerBench& bench, int num_repetitions,
                                    const std::function<void(double)>& on_progress) {
  FingerCharacter character;
  const double num_steps =
      static_cast<double>(kPoses.size()) * num_repetitions + 2.0 * kWeights_kg.size();
  double done = 0.0;
  const auto step_done = [&] {
    if (on_progress) on_progress(++done / num_steps);
  };
  std::array<std::vector<double>, 2> force_n;  // For abduction and extension.
  for (const FingerPose pose : kPoses) {
    BreakAway& entry = character.break_away.emplace_back(BreakAway{.pose = pose});
    for (int repetition = 1; repetition <= num_repetitions; ++repetition) {
      const double along_n =
          share_along_motion(pose) * bench.break_away_weight_n(pose, repetition);
      entry.force_n.push_back(along_n);
      force_n[static_cast<std::size_t>(joint_of(pose))].push_back(along_n);
      step_done();
    }
  }
  character.abduction_n = mean_and_spread(force_n[0]);
  character.extension_n = mean_and_spread(force_n[1]);

  character.weight_kg.assign(kWeights_kg.begin(), kWeights_kg.end());
  std::array<std::vector<TorqueReading>, 2> readings;
  for (const FingerPose pose : {FingerPose::k90, FingerPose::k0}) {
    for (const double weight_kg : kWeights_kg) {
      readings[static_cast<std::size_t>(joint_of(pose))].push_back(
          bench.torques_under(pose, weight_kg * kGravityMPerS2));
      step_done();
    }
  }
  for (int joint = 0; joint < core::kNumJointsPerFinger; ++joint) {
    SensorAccuracy sensor{.joint = joint, .readings = readings[joint == 0 ? 0 : 1]};
    sensor.mean_relative_error_ratio = mean_relative_error(sensor);
    character.sensors.push_back(std::move(sensor));
  }
  return character;
}

std::array<double, core::kNumJointsPerFinger> expected_torque_n_m(
    const JointVector& position_rad, int point, const Eigen::Vector3d& load_n) {
  ExoskeletonKinematics kinematics(Eigen::Vector3d::Zero());
  kinematics.update(position_rad);
  const Eigen::Vector3d of_load_n_m = kinematics.finger_jacobian(point).transpose() * load_n;
  const JointVector gravity_n_m = kinematics.gravity_torque_n_m();
  std::array<double, core::kNumJointsPerFinger> torque_n_m{};
  for (int joint = 0; joint < core::kNumJointsPerFinger; ++joint) {
    torque_n_m[static_cast<std::size_t>(joint)] =
        gravity_n_m[core::finger_joint(point, joint)] - of_load_n_m[joint];
  }
  return torque_n_m;
}

void FreeSpaceRegression::add(const core::Sample& sample) {
  // A finger that hangs free tells nothing about a hand.
  if (sample.attached_bits != kEveryBit) return;
  Eigen::Vector3d velocity_m_per_s = Eigen::Vector3d::Zero();
  for (const core::PlainVector& tip : sample.tip_velocity_m_per_s) {
    velocity_m_per_s += Eigen::Vector3d(tip[0], tip[1], tip[2]) / core::kNumContactPoints;
  }
  const double speed_m_per_s = velocity_m_per_s.norm();
  if (!(speed_m_per_s > kLeastSpeedMPerS)) return;
  ExoskeletonKinematics kinematics(Eigen::Vector3d::Zero());
  kinematics.update(positions_of(sample));
  const double against_n =
      -force_of_fingers_n(kinematics, sample).dot(velocity_m_per_s) / speed_m_per_s;
  // A stretched finger's torques tell nothing about forces along it.
  if (!(std::abs(against_n) < kMostForceN)) return;
  ++num_;
  sum_v_ += speed_m_per_s;
  sum_vv_ += speed_m_per_s * speed_m_per_s;
  sum_f_ += against_n;
  sum_vf_ += speed_m_per_s * against_n;
}

double FreeSpaceRegression::viscosity_n_s_per_m() const noexcept {
  const auto count = static_cast<double>(num_);
  return (count * sum_vf_ - sum_v_ * sum_f_) / (count * sum_vv_ - sum_v_ * sum_v_);
}

double FreeSpaceRegression::friction_n() const noexcept {
  return (sum_f_ - viscosity_n_s_per_m() * sum_v_) / static_cast<double>(num_);
}

}  // namespace jnd::device
