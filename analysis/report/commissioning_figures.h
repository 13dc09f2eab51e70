#pragma once

#include <optional>
#include <vector>

#include "analysis/commissioning/delay_fit.h"
#include "analysis/commissioning/force_fit.h"
#include "analysis/commissioning/frame_fit.h"
#include "analysis/commissioning/noise_fit.h"
#include "analysis/report/figure.h"

namespace jnd::analysis {

/// The measurements of a device. Those that were not made are absent.
struct CommissionedFits {
  std::optional<NoiseFit> noise;
  std::optional<FrameFit> frame;
  std::optional<ForceFit> force;
  std::optional<DelayFit> delay;
};

/// Figures of how marks were met (`device_marks`), force given over force commanded
/// (`device_force`), resistance to motion over speed (`device_resistance`), noise
/// (`device_noise`), and delay and mass (`device_delay`). Each needs a fit that keeps its
/// points. Not real time.
[[nodiscard]] std::vector<Figure> commissioning_figures(const CommissionedFits& fits);

}  // namespace jnd::analysis
