#include "experiments/procedures/stimulus.h"

#include "core/error.h"
#include "experiments/procedures/task.h"
#include "experiments/study/medium_quantity.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
namespace {

core::SolidParameters passive_solid(double stiffness_n_per_m, double friction_ratio) {
  // Enough damping to be passive at 1 kHz: more than stiffness times half a period.
  return {.stiffness_n_per_m = stiffness_n_per_m,
          .damping_n_s_per_m = 0.001 * stiffness_n_per_m,
          .friction_ratio = friction_ratio};
}

}  // namespace

core::MediumAmounts amounts_of(const std::string& medium, double intensity) {
  return amounts_of({.medium = medium, .quantity = "", .intensity = intensity});
}

core::MediumAmounts amounts_of(const MediumSetting& setting) {
  const std::string& medium = setting.medium;
  const double intensity = setting.intensity;
  const core::MediumAmounts buoyant = core::buoyant(setting.buoyancy_n);
  if (medium == "free_space") return core::free_space();
  if (medium == "water") return core::water({.scale = intensity}) + buoyant;
  if (medium == "water_map") return core::mapped_water({.scale = intensity}) + buoyant;
  if (medium == "viscous") return core::viscous({.viscosity_pa_s = intensity}) + buoyant;
  if (medium == "viscous_stokes") {
    return core::viscous(
               {.viscosity_pa_s = intensity, .shape = core::ViscousDrag::Shape::kSphere}) +
           buoyant;
  }
  if (medium == "viscous_schiller_naumann") {
    return core::viscous_inertial({.viscosity_pa_s = intensity}) + buoyant;
  }
  if (medium == "viscous_ellipsoid") {
    return core::ellipsoid({.viscosity_pa_s = intensity}) + buoyant;
  }
  if (medium == "solid") return core::solid(passive_solid(intensity, setting.friction_ratio));
  std::vector<std::string> names;
  for (const MediumQuantity& known : media()) names.push_back(known.medium);
  throw core::Error("medium: expected " + one_of_words(names) + ", found `" + medium + "`");
}

MediumSetting setting_of(const Block& block, const std::string& interval, double intensity) {
  // In a catch trial of a yes-no task nothing is there.
  const bool is_nothing =
      intensity == 0.0 && block.settings.has("task") && task_of(block) == Task::kYesNo;
  if (interval == "free_space" || is_nothing)
    return {.medium = "free_space", .quantity = "", .intensity = 0.0};
  const bool is_standard = interval == "reference" && !block.standard_medium.empty();
  return {.medium = is_standard ? block.standard_medium : block.medium,
          .quantity = is_standard ? quantity_of(block.standard_medium) : block.quantity,
          .intensity = intensity,
          .friction_ratio = block.friction_ratio,
          .buoyancy_n = block.buoyancy_n};
}

core::MediumAmounts surroundings_of(const DeviceNeeds& needs) {
  if (needs.wall_stiffness_n_per_m == 0.0) return core::free_space();
  return core::container(
      passive_solid(needs.wall_stiffness_n_per_m, needs.wall_friction_ratio));
}

std::unique_ptr<const core::ForceMap> force_map_of(const DeviceNeeds& needs) {
  if (needs.force_map.empty()) return nullptr;
  return std::make_unique<const core::ForceMap>(needs.force_map);
}

}  // namespace jnd::experiments
