#include "device/exoskeleton/mujoco_world.h"

#include <mujoco/mujoco.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "core/random_stream.h"
#include "core/require.h"
#include "device/exoskeleton/guiding.h"
#include "device/exoskeleton/model_text.h"

namespace jnd::device {
namespace {

using Eigen::Map;
using Eigen::Vector3d;
using RowMajor3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// Longer steps would make the stiff magnets and stops soft.
constexpr double kMaxStep_s = 0.00125;
// These are assumptions; see README.md beside the model.
constexpr double kArmEncoder_rad = 1e-5;
constexpr double kFingerEncoder_rad = 5e-5;
constexpr double kMagnetReach_m = 0.0003;
constexpr double kMagnetCatches_m_per_s = 0.05;
/// After this time the person who put the finger back turns away.
constexpr double kMagnetHolds_s = 0.5;
constexpr Guiding kFingerGuiding = {.stiffness = 5000.0, .damping = 20.0, .strength = 3.0};
constexpr Guiding kPlatformGuiding = {.stiffness = 200.0, .damping = 40.0, .strength = 15.0};
constexpr Guiding kPlatformTurning = {.stiffness = 5.0, .damping = 0.5, .strength = 1.5};
// Mean relative errors of a finger's torque sensors (thesis, A.4.2), used as errors of gain:
// abduction and extension of the base, distal.
constexpr std::array<double, core::kNumJointsPerFinger> kSensorErrorRatio = {0.0356, 0.0889,
                                                                             0.0083};

double encoder_resolution_rad(int joint) noexcept {
  return joint < core::kNumArmJoints ? kArmEncoder_rad : kFingerEncoder_rad;
}

Vector3d vector_at(const mjtNum* values, int index) noexcept {
  return Map<const Vector3d>(values + 3 * index);
}

RowMajor3d rotation_at(const mjtNum* values, int index) noexcept {
  return Map<const RowMajor3d>(values + 9 * index);
}

}  // namespace

std::string_view exoskeleton_model_text() noexcept { return kExoskeletonModelText; }

MujocoWorld::MujocoWorld(const Parameters& parameters)
    : parameters_(parameters),
      model_(load_mujoco_model(kExoskeletonModelText)),
      addresses_(*model_) {
  core::require_positive(parameters.period_s, "period_s");
  core::require(parameters.break_away_n > 0.0, "break_away_n", "a number > 0",
                parameters.break_away_n);
  core::require(parameters.home_m.allFinite(), "home_m", "finite numbers",
                parameters.home_m.sum());
  core::require(parameters.base_m.allFinite(), "base_m", "finite numbers",
                parameters.base_m.sum());
  num_substeps_ = static_cast<int>(std::ceil(parameters.period_s / kMaxStep_s - 1e-9));
  model_->opt.timestep = parameters.period_s / num_substeps_;
  place();
  data_ = make_mujoco_data(*model_);
  anchor_magnets();

  core::RandomStream random(parameters.sensor_seed, "torque sensor");
  for (int joint = core::kNumArmJoints; joint < core::kNumJoints; ++joint) {
    const double error_ratio =
        kSensorErrorRatio[(joint - core::kNumArmJoints) % core::kNumJointsPerFinger];
    sensor_gain_ratio_[joint] += random.with_probability(0.5) ? error_ratio : -error_ratio;
  }
  reset();
}

void MujocoWorld::place() {
  Map<Vector3d>(model_->body_pos + 3 * addresses_.arm_base_body) = parameters_.base_m;
  Map<Vector3d>(model_->body_pos + 3 * addresses_.forearm_body) = parameters_.home_m;
  const JointVector neutral_rad = neutral_pose_rad();
  for (int joint = 0; joint < core::kNumArmJoints; ++joint) {
    const int brake = addresses_.brake[joint];
    model_->eq_data[brake * mjNEQDATA] = neutral_rad[joint];
    model_->eq_active[brake] = parameters_.arm_joint_locked[joint] ? 1 : 0;
  }
}

/// Places each magnet exactly where the finger's tip is in the neutral pose.
void MujocoWorld::anchor_magnets() {
  reset();
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    const int magnet = addresses_.magnet[point];
    const int body = model_->eq_obj2id[magnet];
    const Vector3d tip_m = vector_at(data_->site_xpos, addresses_.tip_site[point]);
    Map<Vector3d>(model_->eq_data + magnet * mjNEQDATA) =
        vector_at(model_->site_pos, addresses_.tip_site[point]);
    Map<Vector3d>(model_->eq_data + magnet * mjNEQDATA + 3) =
        rotation_at(data_->xmat, body).transpose() * (tip_m - vector_at(data_->xpos, body));
    // In the neutral pose the platform's axes are those of the workspace.
    into_hand_[point] = rotation_at(data_->xmat, body).transpose() *
                        vector_of(kFingerMounts[point].towards_hand);
  }
}

void MujocoWorld::reset() {
  mj_resetData(model_.get(), data_.get());
  const JointVector neutral_rad = neutral_pose_rad();
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    data_->qpos[addresses_.position[joint]] = neutral_rad[joint];
  }
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    data_->qpos[addresses_.distal_position[point]] = kNeutralProximal_rad;
    model_->eq_active[addresses_.magnet[point]] = parameters_.attached[point] ? 1 : 0;
  }
  // The person carries the weight of arm and hand.
  for (int body = addresses_.forearm_body; body < model_->nbody; ++body) {
    data_->xfrc_applied[6 * body + 2] = -model_->opt.gravity[2] * model_->body_mass[body];
  }
  mj_forward(model_.get(), data_.get());
  hold_weight();
  mj_forward(model_.get(), data_.get());
  valid_ = true;
  attached_ = parameters_.attached;
  guided_ = {};
  load_n_ = core::zero_vectors();
  feel();
}

/// The motors hold the robot before any command comes, because a falling robot could not be
/// taken over.
void MujocoWorld::hold_weight() {
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    const int dof = addresses_.dof[joint];
    data_->qfrc_applied[dof] = data_->qfrc_bias[dof];
  }
  // The proximal motor carries the distal link, which follows it.
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    data_->qfrc_applied[addresses_.dof[core::finger_joint(point, 2)]] +=
        data_->qfrc_bias[addresses_.distal_dof[point]];
  }
}

bool MujocoWorld::step(const JointVector& torque_n_m,
                       const Vector3d& pull_on_forearm_n) noexcept {
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    data_->qfrc_applied[addresses_.dof[joint]] = torque_n_m[joint];
  }
  for (int axis = 0; axis < 3; ++axis) {
    data_->qfrc_applied[addresses_.hand_dof[axis]] = pull_on_forearm_n[axis];
  }
  for (int substep = 0; substep < num_substeps_ && valid_; ++substep) {
    push_from_outside();
    valid_ = step_mujoco(*model_, *data_);
    if (valid_) feel();
  }
  return valid_;
}

void MujocoWorld::push_from_outside() noexcept {
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    Vector3d force_n = load_n_[point];
    if (guided_[point] && attached_[point]) {
      held_s_[point] += model_->opt.timestep;
      guided_[point] = held_s_[point] < kMagnetHolds_s;
    } else if (guided_[point]) {
      force_n += guiding_force_n(point);
    }
    const int body = addresses_.distal_body[point];
    const Vector3d lever_m =
        vector_at(data_->site_xpos, addresses_.tip_site[point]) - vector_at(data_->xipos, body);
    push(body, force_n, lever_m.cross(force_n));
  }
  carry_platform();
}

void MujocoWorld::push(int body, const Vector3d& force_n, const Vector3d& torque_n_m) noexcept {
  Map<Vector3d>(data_->xfrc_applied + 6 * body) = force_n;
  Map<Vector3d>(data_->xfrc_applied + 6 * body + 3) = torque_n_m;
}

/// Returns a force towards the magnet's place. Within its reach the magnet takes over.
Vector3d MujocoWorld::guiding_force_n(int point) noexcept {
  const int magnet = addresses_.magnet[point];
  const int body = model_->eq_obj2id[magnet];
  const Vector3d place_m = vector_at(data_->xpos, body) +
                           rotation_at(data_->xmat, body) *
                               Map<const Vector3d>(model_->eq_data + magnet * mjNEQDATA + 3);
  const Vector3d gap_m = place_m - vector_at(data_->site_xpos, addresses_.tip_site[point]);
  double tip_motion[6], body_motion[6];
  mj_objectVelocity(model_.get(), data_.get(), mjOBJ_SITE, addresses_.tip_site[point],
                    tip_motion, 0);
  mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, body, body_motion, 0);
  const Vector3d speed_m_per_s =
      Map<const Vector3d>(tip_motion + 3) - Map<const Vector3d>(body_motion + 3);
  if (gap_m.norm() < kMagnetReach_m && speed_m_per_s.norm() < kMagnetCatches_m_per_s) {
    attached_[point] = true;
    held_s_[point] = 0.0;
    model_->eq_active[magnet] = 1;
    return Vector3d::Zero();
  }
  return kFingerGuiding.effort(gap_m, speed_m_per_s);
}

/// Fingers that are put back can reach the hand only if the platform is there. So if too few
/// hold the hand, the platform is carried back as well.
void MujocoWorld::carry_platform() noexcept {
  const bool somebody_is_there = std::count(guided_.begin(), guided_.end(), true) > 0;
  const auto num_attached = std::count(attached_.begin(), attached_.end(), true);
  const int body = addresses_.platform_body;
  if (!somebody_is_there || num_attached >= 3) {
    push(body, Vector3d::Zero(), Vector3d::Zero());
    return;
  }
  double motion[6];
  mj_objectVelocity(model_.get(), data_.get(), mjOBJ_XBODY, body, motion, 0);
  const Vector3d gap_m =
      hand_m_ + vector_of(kNeutralEndEffector_m) - vector_at(data_->xpos, body);
  // The axis by which it is turned away, times the sine of the angle.
  Vector3d turned_rad = Vector3d::Zero();
  const RowMajor3d axes = rotation_at(data_->xmat, body);
  for (int axis = 0; axis < 3; ++axis) {
    turned_rad += 0.5 * Vector3d::Unit(axis).cross(axes.col(axis));
  }
  push(body,
       kPlatformGuiding.effort(gap_m, Map<const Vector3d>(motion + 3) - hand_velocity_m_per_s_),
       kPlatformTurning.effort(-turned_rad, Map<const Vector3d>(motion)));
}

void MujocoWorld::feel() noexcept {
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    const double resolution_rad = encoder_resolution_rad(joint);
    encoder_rad_[joint] =
        resolution_rad *
        std::nearbyint(data_->qpos[addresses_.position[joint]] / resolution_rad);
  }
  for (int axis = 0; axis < 3; ++axis) {
    hand_m_[axis] = parameters_.home_m[axis] + data_->qpos[addresses_.hand_position[axis]];
    hand_velocity_m_per_s_[axis] = data_->qvel[addresses_.hand_dof[axis]];
  }
  sense_torques();
  let_go_where_pulled();
}

/// A sensor is behind the gear. It measures the motor's torque minus the gear's friction and
/// the torque that the motor needs for its own inertia.
void MujocoWorld::sense_torques() noexcept {
  JointVector torque_n_m;
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    const int dof = addresses_.dof[joint];
    torque_n_m[joint] = data_->qfrc_applied[dof] + data_->qfrc_passive[dof] -
                        model_->dof_armature[dof] * data_->qacc[dof];
  }
  for (int row = 0; row < data_->nefc; ++row) {
    if (data_->efc_type[row] != mjCNSTR_FRICTION_DOF) continue;
    const auto* const joint =
        std::find(addresses_.dof.begin(), addresses_.dof.end(), data_->efc_id[row]);
    if (joint != addresses_.dof.end()) {
      torque_n_m[joint - addresses_.dof.begin()] += data_->efc_force[row];
    }
  }
  sensor_n_m_ = sensor_gain_ratio_.cwiseProduct(torque_n_m);
}

void MujocoWorld::let_go_where_pulled() noexcept {
  magnet_force_n_ = core::zero_vectors();
  for (int row = 0; row + 2 < data_->nefc; ++row) {
    if (data_->efc_type[row] != mjCNSTR_EQUALITY) break;  // Equalities come first.
    const auto* const magnet =
        std::find(addresses_.magnet.begin(), addresses_.magnet.end(), data_->efc_id[row]);
    if (magnet == addresses_.magnet.end()) continue;
    const auto point = static_cast<int>(magnet - addresses_.magnet.begin());
    // Each magnet has three rows, one for each axis. They act on the finger, and in the
    // opposite direction on the hand.
    magnet_force_n_[point] = -Map<const Vector3d>(data_->efc_force + row);
    row += 2;
    if (pulling_n(point) > parameters_.break_away_n) let_go(point);
  }
}

/// Returns the force that pulls the finger off the hand or shears it along. A magnet that is
/// pressed onto the hand holds.
double MujocoWorld::pulling_n(int point) const noexcept {
  const int body = model_->eq_obj2id[addresses_.magnet[point]];
  const Vector3d into_hand = rotation_at(data_->xmat, body) * into_hand_[point];
  const Vector3d& force_n = magnet_force_n_[point];
  return (force_n - std::max(0.0, force_n.dot(into_hand)) * into_hand).norm();
}

void MujocoWorld::let_go(int point) noexcept {
  attached_[point] = false;
  model_->eq_active[addresses_.magnet[point]] = 0;
}

void MujocoWorld::detach(int point) noexcept {
  let_go(point);
  guided_[point] = false;
}

void MujocoWorld::attach(int point) noexcept {
  if (!attached_[point]) guided_[point] = true;
}

}  // namespace jnd::device
