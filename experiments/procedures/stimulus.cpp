#include "experiments/procedures/stimulus.h"

#include "core/error.h"
#include "experiments/procedures/task.h"
#include "experiments/study/media.h"
#include "experiments/study/parameter_table.h"

namespace jnd::experiments {
core::MediumAmounts amounts_of(const std::string& medium, double intensity) {
  return amounts_of({.medium = medium, .quantity = "", .intensity = intensity});
}

core::MediumAmounts amounts_of(const MediumSetting& setting) {
  const Medium* medium = find_medium(setting.medium);
  if (medium == nullptr) {
    std::vector<std::string> names;
    for (const Medium& known : media()) names.push_back(known.name);
    throw core::Error("medium: expected " + one_of_words(names) + ", found `" + setting.medium +
                      "`");
  }
  const core::MediumAmounts amounts = medium->amounts(setting);
  const bool is_fluid = !medium->quantity.empty() && !medium->is_pressed;
  return is_fluid ? amounts + core::buoyant(detail_of(setting, "buoyancy_n")) : amounts;
}

MediumSetting setting_of(const Block& block, const std::string& interval, double intensity) {
  // A catch trial of a yes-no task presents nothing.
  const bool is_nothing =
      intensity == 0.0 && block.settings.has("task") && task_of(block) == Task::kYesNo;
  if (interval == "free_space" || is_nothing)
    return {.medium = "free_space", .quantity = "", .intensity = 0.0};
  const bool is_standard = interval == "reference" && !block.standard_medium.empty();
  return {.medium = is_standard ? block.standard_medium : block.medium,
          .quantity = is_standard ? quantity_of(block.standard_medium) : block.quantity,
          .intensity = intensity,
          .details = block.details};
}

core::MediumAmounts surroundings_of(const DeviceNeeds& needs) {
  if (needs.wall_stiffness_n_per_m == 0.0) return core::free_space();
  // This damping makes the wall as passive as a surface; see `media`.
  return core::container({.stiffness_n_per_m = needs.wall_stiffness_n_per_m,
                          .damping_n_s_per_m = 0.001 * needs.wall_stiffness_n_per_m,
                          .friction_ratio = needs.wall_friction_ratio});
}

std::unique_ptr<const core::ForceMap> force_map_of(const DeviceNeeds& needs) {
  if (needs.force_map.empty()) return nullptr;
  return std::make_unique<const core::ForceMap>(needs.force_map);
}

}  // namespace jnd::experiments
