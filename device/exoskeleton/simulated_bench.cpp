#include "device/exoskeleton/simulated_bench.h"

#include <Eigen/Geometry>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/require.h"
#include "device/haptic_loop.h"

namespace jnd::device {
namespace {

constexpr double kMoved_rad = 0.005;
constexpr double kSettle_s = 0.2;
constexpr double kMostWeight_n = 5.0;
constexpr double kMeasured_s = 10.0;
constexpr double kSwingsOut_s = 1.0;  ///< Waiting time before the measurement.

ExoskeletonDevice::Parameters on_a_bench(const SimulatedBench::Parameters& parameters) {
  core::require(parameters.point >= 0 && parameters.point < core::kNumContactPoints, "point",
                "a contact point, 0 to 4", parameters.point);
  ExoskeletonDevice::Parameters device{.rate_hz = parameters.rate_hz,
                                       .sensor_seed = parameters.sensor_seed};
  device.arm_joint_locked.fill(true);
  device.attached.fill(false);
  return device;
}

[[noreturn]] void fail(const std::string& found) {
  throw core::Error("exoskeleton: expected it to bear the weights, found " + found +
                    "; report this as a bug");
}

}  // namespace

SimulatedBench::SimulatedBench(const Parameters& parameters)
    : parameters_(parameters), exoskeleton_(on_a_bench(parameters)) {}

void SimulatedBench::start() {
  exoskeleton_.open();
  const auto num_ticks = std::lround(kSettle_s * parameters_.rate_hz);
  for (long i = 0; i < num_ticks; ++i) tick(Eigen::Vector3d::Zero());
}

void SimulatedBench::tick(const Eigen::Vector3d& load_n) {
  exoskeleton_.load_tip(parameters_.point, load_n);
  if (!exoskeleton_.write(core::zero_vectors()) || !exoskeleton_.read(state_)) {
    fail(std::string(core::name(exoskeleton_.fault())));
  }
}

JointVector SimulatedBench::position_rad() const {
  return JointVector(state_.joint_position_rad.data());
}

/// Returns the direction of the weight: along the tip's motion, or between that and away from
/// the base.
Eigen::Vector3d SimulatedBench::pull_direction(FingerPose pose) const {
  const Eigen::Matrix3d& jacobian =
      exoskeleton_.kinematics().finger_jacobian(parameters_.point);
  Eigen::Vector3d motion = jacobian.col(joint_of(pose)).normalized();
  switch (pose) {
    case FingerPose::k0:
    case FingerPose::k90:
      return motion;
    case FingerPose::k180:
    case FingerPose::k270:
      return -motion;
    case FingerPose::kInclined:
      break;
  }
  // The motions of abduction and extension are at right angles to the finger.
  const Eigen::Vector3d along = jacobian.col(0).cross(jacobian.col(1)).normalized();
  const Eigen::Vector3d outward =
      along.dot(exoskeleton_.kinematics().tip_position_m()[parameters_.point] -
                exoskeleton_.kinematics().end_effector_position_m()) > 0.0
          ? along
          : Eigen::Vector3d(-along);
  return (motion + outward).normalized();
}

double SimulatedBench::break_away_weight_n(FingerPose pose, int repetition) {
  start();
  const int joint = core::finger_joint(parameters_.point, joint_of(pose));
  const double start_rad = state_.joint_position_rad[joint];
  const Eigen::Vector3d direction = pull_direction(pose);
  core::RandomStream random(parameters_.seed, "filling",
                            {static_cast<std::int64_t>(pose), repetition});
  const double step_n = random.uniform(0.2, 0.4) / parameters_.rate_hz;
  for (double weight_n = 0.0; weight_n < kMostWeight_n; weight_n += step_n) {
    tick(weight_n * direction);
    if (std::abs(state_.joint_position_rad[joint] - start_rad) > kMoved_rad) return weight_n;
  }
  fail("a finger that does not move");
}

TorqueReading SimulatedBench::torques_under(FingerPose pose, double weight_n) {
  start();
  const Eigen::Vector3d load_n = weight_n * pull_direction(pose);
  const auto num_measured = std::lround(kMeasured_s * parameters_.rate_hz);
  for (long i = std::lround(kSwingsOut_s * parameters_.rate_hz); i > 0; --i) tick(load_n);
  TorqueReading mean;
  for (long i = 0; i < num_measured; ++i) {
    tick(load_n);
    const auto expected_n_m = expected_torque_n_m(position_rad(), parameters_.point, load_n);
    for (std::size_t joint = 0; joint < mean.measured_n_m.size(); ++joint) {
      const int index = core::finger_joint(parameters_.point, static_cast<int>(joint));
      mean.measured_n_m[joint] +=
          state_.joint_torque_n_m[index] / static_cast<double>(num_measured);
      mean.expected_n_m[joint] += expected_n_m[joint] / static_cast<double>(num_measured);
    }
  }
  return mean;
}

FreeSpaceRegression stroke_in_free_space(double rate_hz, std::uint64_t seed,
                                         const std::function<void(double)>& on_progress) {
  constexpr std::array kSpeeds_m_per_s = {0.2, 0.4, 0.6};
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  ExoskeletonDevice exoskeleton({.rate_hz = rate_hz});
  HapticLoop loop({.starts_armed = true, .rate_hz = rate_hz}, exoskeleton,
                  {commands, telemetry, stop});
  exoskeleton.open();
  FreeSpaceRegression regression;
  SimulatedHand& hand = *exoskeleton.simulated_hand();
  for (std::size_t i = 0; i < kSpeeds_m_per_s.size(); ++i) {
    const StrokePlan plan{.amplitude_m = 0.2, .max_speed_m_per_s = kSpeeds_m_per_s[i]};
    hand.begin_strokes(plan,
                       core::RandomStream(seed, "stroke", {static_cast<std::int64_t>(i)}));
    // The first stroke is left out, because it starts from rest.
    for (std::int64_t stroke = 0; stroke < 4; stroke = hand.strokes_finished()) {
      loop.tick();
      telemetry.fetch();
      if (telemetry.value().fault != core::Fault::kNone) {
        fail(std::string(core::name(telemetry.value().fault)));
      }
      if (stroke > 0) regression.add(telemetry.value().sample);
    }
    if (on_progress) on_progress(static_cast<double>(i + 1) / kSpeeds_m_per_s.size());
  }
  return regression;
}

}  // namespace jnd::device
