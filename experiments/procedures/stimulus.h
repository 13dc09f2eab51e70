#pragma once

#include <memory>
#include <string>

#include "core/media/force_map.h"
#include "core/media/medium.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// What the haptic loop renders for a medium as studies name it. Throws `Error` for an unknown
/// medium or an intensity out of range.
[[nodiscard]] core::MediumAmounts amounts_of(const std::string& medium, double intensity);
[[nodiscard]] core::MediumAmounts amounts_of(const MediumSetting& setting);

/// The setting of a presentation in a block: its medium, that of its standard where it has one
/// (interval "reference"), or free space, which 0 is in a yes-no task.
[[nodiscard]] MediumSetting setting_of(const Block& block, const std::string& interval,
                                       double intensity);

/// What is felt besides whatever medium is presented: the container's wall and bottom. Throws
/// `Error` for values out of range.
[[nodiscard]] core::MediumAmounts surroundings_of(const DeviceNeeds& needs);

/// The study's force map for `HapticLoop::Parameters`; nullptr where it has none.
[[nodiscard]] std::unique_ptr<const core::ForceMap> force_map_of(const DeviceNeeds& needs);

}  // namespace jnd::experiments
