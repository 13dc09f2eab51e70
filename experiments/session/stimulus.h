#pragma once

#include <string>

#include "core/media/medium.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

/// What the haptic loop renders for a medium as studies name it. Throws `Error` for an unknown
/// medium or an intensity out of range.
[[nodiscard]] core::MediumAmounts amounts_of(const std::string& medium, double intensity);
[[nodiscard]] inline core::MediumAmounts amounts_of(const MediumSetting& setting) {
  return amounts_of(setting.medium, setting.intensity);
}

}  // namespace jnd::experiments
