#pragma once

#include <algorithm>
#include <cmath>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// Where a step (signed, unit of the quantity) leads from the intensity that is set now, in a
/// trial that began at `start_intensity`: whole multiples of the fine step away from there, so
/// that 0.1 + 0.2 does not drift and a start between two stays so, within 0 and the block's
/// end.
[[nodiscard]] inline double stepped_intensity(const Block& block, double start_intensity,
                                              double set_intensity, double step) noexcept {
  double target = set_intensity + step;
  target = start_intensity +
           std::round((target - start_intensity) / block.fine_step) * block.fine_step;
  return std::clamp(target, 0.0, block.max_intensity.value_or(target < 0.0 ? 0.0 : target));
}

}  // namespace jnd::experiments
