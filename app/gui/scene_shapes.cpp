#include "app/gui/scene_shapes.h"

#include <mujoco/mujoco.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace jnd::app::gui {
namespace {

using Eigen::Vector3d;

constexpr SceneColour kSkin = {0.90f, 0.77f, 0.67f};
constexpr double kShortestArrow_m = 0.001;
constexpr double kArrowWidth_m = 0.007;
// An endless surface is drawn as far as the strokes reach, and a little further.
constexpr double kHalfWidth_m = 0.65;
constexpr double kHalfDepth_m = 0.4;

Vector3d vector_of(const core::PlainVector& plain) { return {plain[0], plain[1], plain[2]}; }

/// `size_m` is as in MJCF: for a cylinder, its radius and half its height.
mjvGeom* add_shape(mjvScene& scene, int type, const Vector3d& size_m, const Vector3d& at_m,
                   const SceneColour& colour, float opacity) {
  if (scene.ngeom >= scene.maxgeom) return nullptr;
  mjvGeom* geom = scene.geoms + scene.ngeom++;
  const float rgba[4] = {colour[0], colour[1], colour[2], opacity};
  mjv_initGeom(geom, type, size_m.data(), at_m.data(), nullptr, rgba);
  geom->category = mjCAT_DECOR;
  geom->specular = 0.1f;
  geom->emission = 0.4f;
  return geom;
}

void connect(mjvScene& scene, int type, double width_m, const Vector3d& from_m,
             const Vector3d& to_m, const SceneColour& colour) {
  mjvGeom* geom = add_shape(scene, type, Vector3d::Constant(0.01), from_m, colour, 1.0f);
  if (geom == nullptr) return;
  mjv_makeConnector(geom, type, width_m, from_m.x(), from_m.y(), from_m.z(), to_m.x(), to_m.y(),
                    to_m.z());
}

}  // namespace

bool is_finite(const core::PlainVector& vector) noexcept {
  return std::ranges::all_of(vector, [](double value) { return std::isfinite(value); });
}

void add_ball(mjvScene& scene, const core::PlainVector& at_m, double radius_m,
              const SceneColour& colour) {
  add_shape(scene, mjGEOM_SPHERE, Vector3d::Constant(radius_m), vector_of(at_m), colour, 1.0f);
}

void add_box(mjvScene& scene, const core::PlainVector& at_m, const core::PlainVector& half_m,
             const SceneColour& colour, float opacity) {
  add_shape(scene, mjGEOM_BOX, vector_of(half_m), vector_of(at_m), colour, opacity);
}

void add_arrow(mjvScene& scene, const core::PlainVector& at_m, const core::PlainVector& force_n,
               double m_per_n, const SceneColour& colour) {
  const Vector3d along_m = m_per_n * vector_of(force_n);
  const double length_m = along_m.norm();
  if (!(length_m >= kShortestArrow_m) || !std::isfinite(length_m)) return;
  // MuJoCo draws an arrow at half the length that it is given.
  const Vector3d from_m = vector_of(at_m);
  connect(scene, mjGEOM_ARROW, kArrowWidth_m, from_m, from_m + 2.0 * along_m, colour);
}

void add_hand_shapes(mjvScene& scene, const core::Sample& sample) {
  std::array<Vector3d, core::kNumContactPoints> tip_m;
  std::array<bool, core::kNumContactPoints> holds{};
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    tip_m[point] = vector_of(sample.tip_position_m[point]);
    holds[point] = (sample.attached_bits >> point & 1) != 0 && tip_m[point].allFinite();
  }
  enum { kInner, kOuter, kThumb, kIndex, kMiddle };
  static_assert(core::kContactPointNames[kThumb] == "thumb" &&
                core::kContactPointNames[kMiddle] == "middle");
  const auto bone = [&](double radius_m, const Vector3d& from_m, const Vector3d& to_m) {
    if ((to_m - from_m).norm() > 1e-6) {
      connect(scene, mjGEOM_CAPSULE, radius_m, from_m, to_m, kSkin);
    }
  };
  if (!holds[kInner] || !holds[kOuter]) return;
  bone(0.015, tip_m[kInner], tip_m[kOuter]);
  const Vector3d heel_m = 0.5 * (tip_m[kInner] + tip_m[kOuter]);
  // The knuckles are half-way between the palm's points and the finger tips.
  const Vector3d index_knuckle_m = 0.5 * (tip_m[kInner] + tip_m[kIndex]);
  const Vector3d middle_knuckle_m = 0.5 * (tip_m[kOuter] + tip_m[kMiddle]);
  if (holds[kThumb]) bone(0.010, tip_m[kInner], tip_m[kThumb]);
  if (holds[kIndex]) {
    bone(0.015, tip_m[kInner], index_knuckle_m);
    bone(0.009, index_knuckle_m, tip_m[kIndex]);
  }
  if (holds[kMiddle]) {
    bone(0.015, tip_m[kOuter], middle_knuckle_m);
    bone(0.009, middle_knuckle_m, tip_m[kMiddle]);
  }
  if (!holds[kIndex] || !holds[kMiddle]) return;
  bone(0.015, index_knuckle_m, middle_knuckle_m);
  bone(0.015, heel_m, 0.5 * (index_knuckle_m + middle_knuckle_m));
  const Vector3d back = (heel_m - 0.5 * (tip_m[kIndex] + tip_m[kMiddle])).normalized();
  bone(0.026, heel_m + 0.03 * back, heel_m + 0.24 * back);
}

void add_fluid_shapes(mjvScene& scene, const SurroundingsView& surroundings,
                      const SceneColours& colours) {
  const core::Immersion& fluid = surroundings.immersion;
  const Vector3d middle_m(fluid.origin_x_m, fluid.origin_y_m, fluid.origin_z_m);
  const bool has_end = std::isfinite(fluid.radius_m);
  const auto add_level = [&](double height_m, const SceneColour& colour, float opacity) {
    const Vector3d at_m(middle_m.x(), middle_m.y(), height_m);
    constexpr double kThin_m = 0.0005;
    if (has_end) {
      add_shape(scene, mjGEOM_CYLINDER, {fluid.radius_m, kThin_m, 0.0}, at_m, colour, opacity);
    } else {
      add_shape(scene, mjGEOM_BOX, {kHalfWidth_m, kHalfDepth_m, kThin_m}, at_m, colour,
                opacity);
    }
  };
  const bool has_floor = std::isfinite(fluid.depth_m);
  if (has_floor) {
    add_level(middle_m.z() - fluid.depth_m, colours.solid,
              surroundings.has_walls ? 0.7f : 0.2f);
  }
  if (has_end) {
    const double half_m = 0.5 * (has_floor ? fluid.depth_m : 0.5);
    add_shape(scene, mjGEOM_CYLINDER, {fluid.radius_m, half_m, 0.0},
              middle_m - half_m * Vector3d::UnitZ(), colours.solid,
              surroundings.has_walls ? 0.25f : 0.1f);
  }
  // The surface comes last, because it is drawn over what is below.
  if (surroundings.surface_is_solid) {
    add_level(middle_m.z(), colours.solid, 0.75f);
  } else {
    add_level(middle_m.z(), colours.surface, 0.16f);
  }
}

}  // namespace jnd::app::gui
