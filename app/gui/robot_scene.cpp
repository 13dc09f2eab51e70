#include "app/gui/robot_scene.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/gui/scene_shapes.h"
#include "core/sample_table.h"
#include "device/exoskeleton/mujoco_world.h"

namespace jnd::app::gui {
namespace {

constexpr int kMaxShapes = 400;
// The person's shapes are hidden, because a sample tells only where the tips are.
constexpr int kPersonGroup = 5;
constexpr float kRobotShade[4] = {0.62f, 0.66f, 0.72f, 1.0f};
constexpr float kFingerShade[4] = {0.80f, 0.82f, 0.86f, 1.0f};

/// Adds a background of one colour to the model; MuJoCo can have one only as a texture.
std::string model_text_with_background() {
  std::string text(device::exoskeleton_model_text());
  const std::size_t world = text.find("<worldbody>");
  if (world != std::string::npos) {
    text.insert(world,
                "<asset><texture name=\"background\" type=\"skybox\" builtin=\"flat\" "
                "rgb1=\"1 1 1\" rgb2=\"1 1 1\" width=\"4\" height=\"24\"/></asset>");
  }
  return text;
}

SceneColour colour_from(std::uint32_t packed) {
  const auto channel = [&](int shift) {
    return static_cast<float>(packed >> shift & 0xff) / 255.0f;
  };
  return {channel(0), channel(8), channel(16)};
}

}  // namespace

SceneColours scene_colours(const Theme& theme) {
  const auto of = [&](Colour colour) { return colour_from(theme.line_rgba(colour)); };
  return {.ground = of(Colour::kCard),
          .force = of(Colour::kAmber),
          .in_fluid = of(Colour::kBlue),
          .dry = of(Colour::kSoft),
          .loose = of(Colour::kPilot),
          .surface = of(Colour::kBlue),
          .solid = of(Colour::kSoft)};
}

/// Where things are in the model; -1 for things that it does not have.
struct RobotScene::Addresses {
  std::array<int, core::kNumJoints> joint_position{};
  std::array<int, core::kNumContactPoints> distal_position{};
  int base_body = -1, end_effector_body = -1;
};

RobotScene::RobotScene()
    : model_(device::load_mujoco_model(model_text_with_background())),
      data_(device::make_mujoco_data(*model_)),
      scene_(std::make_unique<mjvScene>()),
      addresses_(std::make_unique<Addresses>()) {
  mj_resetData(model_.get(), data_.get());
  look_up_names();
  background_texture_ = mj_name2id(model_.get(), mjOBJ_TEXTURE, "background");
  auto& head_light = model_->vis.headlight;
  for (int i = 0; i < 3; ++i) {
    head_light.ambient[i] = 0.35f;
    head_light.diffuse[i] = 0.35f;
    head_light.specular[i] = 0.1f;
  }
  for (int i = 0; i < 3 * model_->nlight; ++i) model_->light_diffuse[i] = 0.35f;
  model_->vis.quality.shadowsize = 0;
  mjv_defaultScene(scene_.get());
  mjv_makeScene(model_.get(), scene_.get(), kMaxShapes);
  scene_->flags[mjRND_SHADOW] = scene_->flags[mjRND_REFLECTION] = 0;
  scene_->flags[mjRND_HAZE] = 0;
}

RobotScene::~RobotScene() { mjv_freeScene(scene_.get()); }

void RobotScene::look_up_names() {
  const auto position_of = [&](const std::string& joint) {
    const int id = mj_name2id(model_.get(), mjOBJ_JOINT, joint.c_str());
    return id < 0 ? -1 : model_->jnt_qposadr[id];
  };
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    addresses_->joint_position[joint] = position_of(std::string(core::kJointNames[joint]));
  }
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    addresses_->distal_position[point] =
        position_of(std::string(core::kContactPointNames[point]) + "_distal");
  }
  addresses_->base_body = mj_name2id(model_.get(), mjOBJ_BODY, "arm_base");
  addresses_->end_effector_body = mj_name2id(model_.get(), mjOBJ_BODY, "platform");
  for (int geom = 0; geom < model_->ngeom; ++geom) {
    const int body = model_->geom_bodyid[geom];
    if (addresses_->base_body >= 0 && model_->body_rootid[body] != addresses_->base_body) {
      model_->geom_group[geom] = kPersonGroup;
      continue;
    }
    // Only forces are amber, so the robot gets shades of its own.
    const char* name = mj_id2name(model_.get(), mjOBJ_BODY, body);
    const bool is_arm = name != nullptr && std::string_view(name).starts_with("arm_");
    float* rgba = model_->geom_rgba + 4 * geom;
    std::copy_n(is_arm ? kRobotShade : kFingerShade, 4, rgba);
    // The platform's plate is translucent, because forces are behind it half of the time.
    if (model_->geom_type[geom] == mjGEOM_BOX) rgba[3] = 0.35f;
  }
}

void RobotScene::show(const core::Sample& sample, const SurroundingsView& surroundings,
                      const SceneColours& colours, const SceneCamera& camera) {
  place_robot(sample);
  mjvOption option;
  mjv_defaultOption(&option);
  const bool has_robot = core::has_joints(sample);
  for (int group = 0; group < mjNGROUP; ++group) {
    option.geomgroup[group] = has_robot && group != kPersonGroup ? 1 : 0;
    option.sitegroup[group] = 0;
  }
  mjvCamera seen_from;
  mjv_defaultCamera(&seen_from);
  constexpr double kDegreesPerRad = 180.0 / mjPI;
  seen_from.azimuth = kDegreesPerRad * camera.azimuth_rad;
  seen_from.elevation = kDegreesPerRad * camera.elevation_rad;
  seen_from.distance = camera.distance_m;
  std::ranges::copy(camera.look_at_m, seen_from.lookat);
  mjv_updateScene(model_.get(), data_.get(), &option, nullptr, &seen_from, mjCAT_ALL,
                  scene_.get());
  add_hand_shapes(*scene_, sample);
  add_points(sample, colours);
  add_fluid_shapes(*scene_, surroundings, colours);
}

void RobotScene::place_robot(const core::Sample& sample) {
  const auto set = [&](int address, double value) {
    if (address >= 0 && std::isfinite(value)) data_->qpos[address] = value;
  };
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    set(addresses_->joint_position[joint], sample.joint_position_rad[joint]);
  }
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    set(addresses_->distal_position[point],
        sample.joint_position_rad[core::finger_joint(point, 2)]);
  }
  mj_kinematics(model_.get(), data_.get());
  // The sample does not tell where the arm's foot is, but where its end is. So the foot is
  // moved until the end is there.
  if (addresses_->base_body >= 0 && addresses_->end_effector_body >= 0 &&
      is_finite(sample.end_effector_position_m)) {
    mjtNum* foot_m = model_->body_pos + 3 * addresses_->base_body;
    const mjtNum* end_m = data_->xpos + 3 * addresses_->end_effector_body;
    for (int axis = 0; axis < 3; ++axis) {
      foot_m[axis] += sample.end_effector_position_m[axis] - end_m[axis];
    }
    mj_kinematics(model_.get(), data_.get());
  }
  mj_camlight(model_.get(), data_.get());
}

void RobotScene::add_points(const core::Sample& sample, const SceneColours& colours) {
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    const core::PlainVector& tip_m = sample.tip_position_m[point];
    if (!is_finite(tip_m)) continue;
    const bool is_attached = (sample.attached_bits >> point & 1) != 0;
    const bool is_in_fluid = (sample.immersed_bits >> point & 1) != 0;
    if (!is_attached) {
      add_box(*scene_, tip_m, {0.011, 0.011, 0.011}, colours.loose);
    } else if (is_in_fluid) {
      add_ball(*scene_, tip_m, 0.012, colours.in_fluid);
    } else {
      add_ball(*scene_, tip_m, 0.008, colours.dry);
    }
    add_arrow(*scene_, tip_m, sample.tip_force_n[point], kArrow_m_per_n, colours.force);
  }
}

}  // namespace jnd::app::gui
