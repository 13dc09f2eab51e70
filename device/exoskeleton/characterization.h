#pragma once

#include <array>
#include <functional>
#include <string_view>
#include <vector>

#include "core/sample.h"
#include "device/exoskeleton/geometry.h"

namespace jnd::device {

/// How a finger is turned under the weight at its tip, as in the thesis (A.4, fig. A.7). The
/// weight pulls along the tip's motion by one of the two joints of its base, in either
/// direction, or at 45 degrees to it, along the finger.
enum class FingerPose { k0, k90, k180, k270, kInclined };

inline constexpr std::array<std::string_view, 5> kFingerPoseNames = {"0", "90", "180", "270",
                                                                     "inclined_45"};
/// Returns which of the finger's joints shall break away: 0 abduction, 1 extension.
[[nodiscard]] constexpr int joint_of(FingerPose pose) noexcept {
  return pose == FingerPose::k90 || pose == FingerPose::k270 ? 0 : 1;
}

/// Returns the share of the weight that pulls along the tip's motion.
[[nodiscard]] double share_along_motion(FingerPose pose) noexcept;

/// Torques of one finger's joints (abduction, extension, proximal): as measured by its sensors,
/// and as expected from the weight at the tip and the links' weight, by the kinematics at the
/// measured pose.
struct TorqueReading {
  std::array<double, core::kNumJointsPerFinger> measured_n_m{};
  std::array<double, core::kNumJointsPerFinger> expected_n_m{};
};

/// One finger, with somebody who hangs weights at its tip. Its functions throw exceptions of
/// their own.
class FingerBench {
 public:
  virtual ~FingerBench() = default;
  /// Returns the weight, in newtons, that just makes the finger move. Not real time.
  [[nodiscard]] virtual double break_away_weight_n(FingerPose pose, int repetition) = 0;
  /// Returns the mean over ten seconds with this weight. Not real time.
  [[nodiscard]] virtual TorqueReading torques_under(FingerPose pose, double weight_n) = 0;
};

struct MeanAndSpread {
  double mean = 0.0;
  double sd = 0.0;  ///< Sample standard deviation; 0 for a single value.
};
[[nodiscard]] MeanAndSpread mean_and_spread(const std::vector<double>& values);

/// Break-away forces along the tip's motion.
struct BreakAway {
  FingerPose pose = FingerPose::k0;
  std::vector<double> force_n;
};

/// Error of a joint's torque sensor. As in the thesis, it is the mean of |measured / expected -
/// 1| over the weights, without the lightest.
struct SensorAccuracy {
  int joint = 0;  ///< Of the finger: 0 abduction, 1 extension, 2 proximal.
  double mean_relative_error_ratio = 0.0;
  std::vector<TorqueReading> readings;  ///< One for each weight.
};

struct FingerCharacter {
  std::vector<BreakAway> break_away;  ///< In five poses.
  MeanAndSpread extension_n, abduction_n;
  std::vector<double> weight_kg;
  std::vector<SensorAccuracy> sensors;  ///< For abduction, extension and proximal joint.
};

inline constexpr double kGravityMPerS2 = 9.81;

/// Runs the experiments of the thesis (A.4): break-away in five poses, then weights of 50 to
/// 250 g in two of them. `on_progress` gets 0 to 1 and may throw to stop; it may be empty. Not
/// real time.
[[nodiscard]] FingerCharacter characterize_finger(
    FingerBench& bench, int num_repetitions,
    const std::function<void(double)>& on_progress = {});

/// Returns the torques that a finger's joints should report at these joint angles with that
/// load at its tip, which the motors hold at rest. The load is in the workspace frame.
[[nodiscard]] std::array<double, core::kNumJointsPerFinger> expected_torque_n_m(
    const JointVector& position_rad, int point, const Eigen::Vector3d& load_n);

/// What the device itself does to a moving hand in free space: a straight line of the force
/// against the motion over the speed, by least squares,
///
///   force = viscosity * speed + friction.
///
/// The force is what the tips exert on the hand according to the fingers' torque sensors, with
/// their errors. The links' inertia averages out over whole strokes.
class FreeSpaceRegression {
 public:
  /// Below this speed of the hand, a sample has no clear direction.
  static constexpr double kLeastSpeedMPerS = 0.05;

  void add(const core::Sample& sample);

  [[nodiscard]] double viscosity_n_s_per_m() const noexcept;
  [[nodiscard]] double friction_n() const noexcept;
  [[nodiscard]] long num_samples() const noexcept { return num_; }

 private:
  long num_ = 0;
  double sum_v_ = 0.0, sum_vv_ = 0.0, sum_f_ = 0.0, sum_vf_ = 0.0;
};

}  // namespace jnd::device
