#pragma once

#include <optional>
#include <vector>

#include "analysis/commissioning/delay_fit.h"
#include "analysis/commissioning/force_fit.h"
#include "analysis/commissioning/frame_fit.h"
#include "analysis/commissioning/noise_fit.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

/// What was measured of a device; what was not is absent.
struct CommissionedFits {
  std::optional<NoiseFit> noise;
  std::optional<FrameFit> frame;
  std::optional<ForceFit> force;
  std::optional<DelayFit> delay;
};

/// Where marks were met (`device_marks`), force given over force commanded (`device_force`),
/// what the device opposes to motion over speed (`device_resistance`), noise (`device_noise`),
/// delay and mass (`device_delay`): each where the fit keeps the points for it. Not real time.
[[nodiscard]] std::vector<Figure> commissioning_figures(const CommissionedFits& fits);

}  // namespace jnd::analysis
