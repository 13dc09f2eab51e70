#pragma once

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <string>

#include "core/random_stream.h"
#include "device/exoskeleton/geometry.h"
#include "device/exoskeleton/mujoco_guard.h"
#include "device/exoskeleton/mujoco_world.h"

namespace jnd::device {

/// The model alone, in any pose, with its arm's foot at any place: a second opinion on our own
/// kinematics.
class Reference {
 public:
  explicit Reference(const Eigen::Vector3d& base_m)
      : model(load_mujoco_model(std::string(exoskeleton_model_text()))),
        data(make_mujoco_data(*model)) {
    const int base = mj_name2id(model.get(), mjOBJ_BODY, "arm_base");
    Eigen::Map<Eigen::Vector3d>(model->body_pos + 3 * base) = base_m;
  }

  [[nodiscard]] int joint(const std::string& name) const {
    return mj_name2id(model.get(), mjOBJ_JOINT, name.c_str());
  }
  [[nodiscard]] int dof(int joint_index) const {
    return model->jnt_dofadr[joint(std::string(core::kJointNames[joint_index]))];
  }
  [[nodiscard]] int distal_dof(int point) const {
    return model->jnt_dofadr[joint(std::string(core::kContactPointNames[point]) + "_distal")];
  }

  void pose(const JointVector& position_rad) {
    mj_resetData(model.get(), data.get());
    for (int index = 0; index < core::kNumJoints; ++index) {
      data->qpos[model->jnt_qposadr[joint(std::string(core::kJointNames[index]))]] =
          position_rad[index];
    }
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      const std::string name = std::string(core::kContactPointNames[point]) + "_distal";
      data->qpos[model->jnt_qposadr[joint(name)]] = position_rad[core::finger_joint(point, 2)];
    }
    mj_forward(model.get(), data.get());
  }

  [[nodiscard]] Eigen::Vector3d tip_m(int point) const {
    return Eigen::Map<const Eigen::Vector3d>(data->site_xpos + 3 * tip_site(point));
  }
  [[nodiscard]] Eigen::Vector3d body_m(const char* name) const {
    return Eigen::Map<const Eigen::Vector3d>(data->xpos +
                                             3 * mj_name2id(model.get(), mjOBJ_BODY, name));
  }

  /// d tip / d joint over all 22 joints, where the distal joint turns together with the
  /// proximal one.
  [[nodiscard]] Eigen::Matrix<double, 3, core::kNumJoints> tip_jacobian(int point) const {
    Eigen::Matrix<double, 3, Eigen::Dynamic, Eigen::RowMajor> all(3, model->nv);
    mj_jacSite(model.get(), data.get(), all.data(), nullptr, tip_site(point));
    Eigen::Matrix<double, 3, core::kNumJoints> jacobian;
    for (int index = 0; index < core::kNumJoints; ++index)
      jacobian.col(index) = all.col(dof(index));
    jacobian.col(core::finger_joint(point, 2)) += all.col(distal_dof(point));
    return jacobian;
  }

  [[nodiscard]] JointVector gravity_torque_n_m() const {
    JointVector torque_n_m;
    for (int index = 0; index < core::kNumJoints; ++index) {
      torque_n_m[index] = data->qfrc_bias[dof(index)];
    }
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      torque_n_m[core::finger_joint(point, 2)] += data->qfrc_bias[distal_dof(point)];
    }
    return torque_n_m;
  }

  MujocoModel model;
  MujocoData data;

 private:
  [[nodiscard]] int tip_site(int point) const {
    const std::string name = std::string(core::kContactPointNames[point]) + "_tip";
    return mj_name2id(model.get(), mjOBJ_SITE, name.c_str());
  }
};

/// Returns a random pose between the stops.
[[nodiscard]] inline JointVector random_pose_rad(core::RandomStream& random) {
  JointVector pose_rad;
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    const JointRange range = range_of(joint);
    pose_rad[joint] = random.uniform(range.low_rad, range.high_rad);
  }
  return pose_rad;
}

}  // namespace jnd::device
