#include "device/exoskeleton/model_addresses.h"

#include <mujoco/mujoco.h>

#include <string>

#include "core/error.h"

namespace jnd::device {
namespace {

int id_of(const mjModel& model, mjtObj type, const std::string& name) {
  const int id = mj_name2id(&model, type, name.c_str());
  if (id >= 0) return id;
  throw core::Error("data/models/exoskeleton.xml: expected a " +
                    std::string(mju_type2Str(type)) + " named " + name + ", found none");
}

}  // namespace

ModelAddresses::ModelAddresses(const mjModel& model) {
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    const int id = id_of(model, mjOBJ_JOINT, std::string(core::kJointNames[joint]));
    position[joint] = model.jnt_qposadr[id];
    dof[joint] = model.jnt_dofadr[id];
  }
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    const std::string name(core::kContactPointNames[point]);
    tip_site[point] = id_of(model, mjOBJ_SITE, name + "_tip");
    distal_body[point] = id_of(model, mjOBJ_BODY, name + "_distal");
    const int distal = id_of(model, mjOBJ_JOINT, name + "_distal");
    distal_position[point] = model.jnt_qposadr[distal];
    distal_dof[point] = model.jnt_dofadr[distal];
    magnet[point] = id_of(model, mjOBJ_EQUALITY, name + "_magnet");
  }
  for (int joint = 0; joint < core::kNumArmJoints; ++joint) {
    brake[joint] =
        id_of(model, mjOBJ_EQUALITY, std::string(core::kJointNames[joint]) + "_brake");
  }
  for (int axis = 0; axis < 3; ++axis) {
    const int id = id_of(model, mjOBJ_JOINT, std::string("hand_") + "xyz"[axis]);
    hand_position[axis] = model.jnt_qposadr[id];
    hand_dof[axis] = model.jnt_dofadr[id];
  }
  arm_base_body = id_of(model, mjOBJ_BODY, "arm_base");
  platform_body = id_of(model, mjOBJ_BODY, "platform");
  forearm_body = id_of(model, mjOBJ_BODY, "forearm");
}

}  // namespace jnd::device
