#pragma once

#include <algorithm>
#include <cmath>

#include "experiments/study/study.h"

namespace jnd::experiments {

/// Returns the decimal number that is meant, such as 8.6 if 28 - 194 * 0.1 gives
/// 8.599999999999998. It rounds to nine digits beyond the fine step, and leaves numbers as they
/// are that are too large for that.
[[nodiscard]] inline double as_meant(double intensity, double fine_step) noexcept {
  constexpr double kLargestWhole = 4503599627370496.0;  // 2^52
  const double digits = 9.0 - std::floor(std::log10(fine_step));
  const double scale = std::pow(10.0, digits);
  const double scaled = intensity * scale;
  return std::abs(scaled) < kLargestWhole ? std::round(scaled) / scale : intensity;
}

/// Returns where a step (signed, in the unit of the quantity) leads from the current intensity,
/// in a trial that began at `start_intensity`. The result is a whole number of fine steps away
/// from the start. So 0.1 + 0.2 does not drift, and a start between two steps stays between
/// them. It is within 0 and the block's end. A matching stays above 0, where nothing could be
/// matched: it stops at one fine step, or at the start if that is less.
[[nodiscard]] inline double stepped_intensity(const Block& block, double start_intensity,
                                              double set_intensity, double step) noexcept {
  double target = set_intensity + step;
  target = start_intensity +
           std::round((target - start_intensity) / block.fine_step) * block.fine_step;
  target = as_meant(target, block.fine_step);
  const double least =
      block.procedure == "matching" ? std::min(block.fine_step, start_intensity) : 0.0;
  return std::max(least, std::min(target, block.max_intensity.value_or(target)));
}

}  // namespace jnd::experiments
