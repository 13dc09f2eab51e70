#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>

#include "core/hand.h"
#include "device/exoskeleton/geometry.h"
#include "device/exoskeleton/model_addresses.h"
#include "device/exoskeleton/mujoco_guard.h"

namespace jnd::device {

/// Returns the text of the model from which every `MujocoWorld` is made, for programs that draw
/// it. Its joints have the names of `core::kJointNames`.
[[nodiscard]] std::string_view exoskeleton_model_text() noexcept;

/// The simulated apparatus with a person's hand on it, as seen from outside: joint torques and
/// the pull of the person's arm go in, and sensor readings with their errors come out. It knows
/// neither control nor medium. The same torques give the same motion to the bit.
///
/// A magnet connects each contact point to the hand, and lets go above its break-away force.
/// `attach` is somebody who guides the loose finger back to its place.
class MujocoWorld {
 public:
  struct Parameters {
    double period_s = 0.001;                           ///< Duration of one `step`, > 0.
    Eigen::Vector3d home_m{0.0, 0.0, -0.15};           ///< Middle of the hand at the start.
    Eigen::Vector3d base_m = Eigen::Vector3d::Zero();  ///< The arm's foot.
    std::array<bool, core::kNumArmJoints> arm_joint_locked{};
    std::array<bool, core::kNumContactPoints> attached = core::kAllAttached;
    double break_away_n = 25.0;  ///< Of each magnet, > 0.
    /// Determines which sensors read too much and which too little.
    std::uint64_t sensor_seed = 1;
  };

  /// Throws `core::Error` naming the field. Not real time.
  explicit MujocoWorld(const Parameters& parameters);

  /// Resets to rest in the neutral pose, with the magnets as at first. Not real time.
  void reset();

  /// Simulates one period with these joint torques and this pull of the person's arm on the
  /// forearm. Returns false if the simulation is invalid, which it stays until `reset`. Real
  /// time.
  [[nodiscard]] bool step(const JointVector& torque_n_m,
                          const Eigen::Vector3d& pull_on_forearm_n) noexcept;
  [[nodiscard]] bool is_valid() const noexcept { return valid_; }

  // These return the sensor readings. Real time.
  [[nodiscard]] const JointVector& encoder_position_rad() const noexcept {
    return encoder_rad_;
  }
  [[nodiscard]] const JointVector& sensor_torque_n_m() const noexcept { return sensor_n_m_; }
  [[nodiscard]] const std::array<bool, core::kNumContactPoints>& attached() const noexcept {
    return attached_;
  }

  // These return the hand's true position and velocity. Real time.
  [[nodiscard]] const Eigen::Vector3d& hand_position_m() const noexcept { return hand_m_; }
  [[nodiscard]] const Eigen::Vector3d& hand_velocity_m_per_s() const noexcept {
    return hand_velocity_m_per_s_;
  }
  /// Returns the force of each magnet on the hand; 0 if it does not hold.
  [[nodiscard]] const core::PointVectors& magnet_force_on_hand_n() const noexcept {
    return magnet_force_n_;
  }

  /// Takes a finger off the hand. Real time.
  void detach(int point) noexcept;
  /// From now on somebody guides the finger to its place, with 3 N at most, until its magnet
  /// has held for half a second. If fewer than three magnets hold, the platform is carried
  /// along. Real time.
  void attach(int point) noexcept;
  /// Sets a load on a tip, in the workspace frame, such as a weight that hangs there. It stays
  /// until the next call. Real time.
  void load_tip(int point, const Eigen::Vector3d& force_n) noexcept {
    load_n_[point] = force_n;
  }

  [[nodiscard]] const mjModel_& model() const noexcept { return *model_; }
  [[nodiscard]] const mjData_& data() const noexcept { return *data_; }

 private:
  void place();
  void anchor_magnets();
  void hold_weight();
  [[nodiscard]] double pulling_n(int point) const noexcept;
  void push_from_outside() noexcept;
  void push(int body, const Eigen::Vector3d& force_n,
            const Eigen::Vector3d& torque_n_m) noexcept;
  [[nodiscard]] Eigen::Vector3d guiding_force_n(int point) noexcept;
  void carry_platform() noexcept;
  void feel() noexcept;
  void sense_torques() noexcept;
  void let_go_where_pulled() noexcept;
  void let_go(int point) noexcept;

  Parameters parameters_;
  MujocoModel model_;
  MujocoData data_;
  ModelAddresses addresses_;
  int num_substeps_ = 1;
  JointVector sensor_gain_ratio_ = JointVector::Ones();
  bool valid_ = true;

  JointVector encoder_rad_ = JointVector::Zero();
  JointVector sensor_n_m_ = JointVector::Zero();
  std::array<bool, core::kNumContactPoints> attached_ = core::kAllAttached;
  std::array<bool, core::kNumContactPoints> guided_{};
  /// Time since a guided finger is back.
  std::array<double, core::kNumContactPoints> held_s_{};
  core::PointVectors load_n_ = core::zero_vectors();
  core::PointVectors into_hand_;  ///< Unit vectors in the frame of the magnet's body.
  core::PointVectors magnet_force_n_ = core::zero_vectors();
  Eigen::Vector3d hand_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d hand_velocity_m_per_s_ = Eigen::Vector3d::Zero();
};

}  // namespace jnd::device
