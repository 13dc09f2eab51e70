#include "experiments/protocol/stimulus_place.h"

#include <nlohmann/json.hpp>

#include "experiments/protocol/located_json.h"
#include "experiments/study/rule_values.h"
#include "experiments/study/stage_walk.h"

namespace jnd::experiments {
namespace {

using nlohmann::json;

/// Returns the pointer of the stage with this name, or "".
std::string stage_pointer(const json& root, const std::string& name) {
  std::string found;
  for_each_written_stage(root, [&](const json& stage, const std::string& pointer) {
    if (found.empty() && word(stage, "name") == name) found = pointer;
  });
  return found;
}

/// Returns the pointer of a number with this value at a key that names the quantity, or "".
std::string number_pointer(const json& value, const std::string& pointer,
                           const MediumSetting& setting) {
  if (!value.is_structured()) return "";
  const auto is_other_medium = [&](const std::string& key) {
    const char* decider = key.starts_with("standard_") ? "standard_medium" : "medium";
    return value.is_object() && value.contains(decider) &&
           word(value, decider) != setting.medium;
  };
  for (const auto& [key, inner] : value.items()) {
    std::string here = pointer + '/' + pointer_token(key);
    // Such keys are `viscosity_pa_s`, `reference_viscosity_pa_s` and `max_viscosity_pa_s`. A
    // step is no stimulus.
    if (key.ends_with(setting.quantity) && key.find("_step_") == std::string::npos &&
        !is_other_medium(key)) {
      if (inner.is_number() && inner.get<double>() == setting.intensity) return here;
      for (std::size_t i = 0; inner.is_array() && i < inner.size(); ++i) {
        if (inner[i].is_number() && inner[i].get<double>() == setting.intensity) {
          return here + '/' + std::to_string(i);
        }
      }
    }
    std::string found = number_pointer(inner, here, setting);
    if (!found.empty()) return found;
  }
  return "";
}

}  // namespace

std::string stimulus_pointer(const json& root, const std::string& stage_name,
                             const MediumSetting& setting) {
  std::string stage = stage_pointer(root, stage_name);
  if (stage.empty() || setting.quantity.empty()) return stage;
  const std::string found = number_pointer(root.at(json::json_pointer(stage)), stage, setting);
  return found.empty() ? stage : found;
}

}  // namespace jnd::experiments
