#pragma once

#include <memory>
#include <string>

#include "core/media/force_map.h"
#include "core/media/medium.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// Returns what the haptic loop renders for a medium, by its name in studies. Throws `Error`
/// for an unknown medium or an intensity out of range.
[[nodiscard]] core::MediumAmounts amounts_of(const std::string& medium, double intensity);
[[nodiscard]] core::MediumAmounts amounts_of(const MediumSetting& setting);

/// Returns the setting of a presentation in a block: its medium, that of its standard if it has
/// one (interval "reference"), or free space. In a yes-no task an intensity of 0 is free space.
[[nodiscard]] MediumSetting setting_of(const Block& block, const std::string& interval,
                                       double intensity);

/// Returns what is felt besides the presented medium: the container's wall and bottom. Throws
/// `Error` for values out of range.
[[nodiscard]] core::MediumAmounts surroundings_of(const DeviceNeeds& needs);

/// Returns the study's force map for `HapticLoop::Parameters`, or nullptr if it has none.
[[nodiscard]] std::unique_ptr<const core::ForceMap> force_map_of(const DeviceNeeds& needs);

}  // namespace jnd::experiments
