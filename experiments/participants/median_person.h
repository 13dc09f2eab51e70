#pragma once

#include "core/media/force_map.h"
#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

// The values that estimates from a simulated laboratory would have without noise.

/// Returns the laboratory with its median person alone, who reads without noise and never
/// lapses, learns, tires or looks twice. Systematic effects stay: shrinking towards the centre
/// of the range, round numbers, and the pull of the starting value and of the previous answer.
[[nodiscard]] Laboratory without_noise(Laboratory laboratory);

/// Returns the Weber fraction of the median person in a block with a reference, in its varied
/// quantity. It is the relative step that is felt as a factor 1 + w0 of the total damping,
///
///   felt(reference (1 + w)) = (1 + w0) felt(reference),
///
/// which is w0 (1 + b / (c reference)) for a viscous fluid of damping c x on a device of
/// viscosity b. For a solid it is the Weber fraction for stiffness. Lapses, learning and
/// fatigue, which increase it, are left out. Throws `Error` for a block without a reference >
/// 0.
[[nodiscard]] double median_weber_fraction(const Laboratory& laboratory, const Block& block,
                                           const core::ForceMap* map = nullptr);

/// Returns the Weber fraction of a curve that is symmetric in ln of the intensity, as fitted
/// curves are. It is half the distance in ln between the intensities below and above the
/// reference at which the median person is right in 84.13 % of the trials,
///
///   ln(1 + w) = (ln(x_up / reference) + ln(reference / x_down)) / 2,
///   felt(x_up) = (1 + w0) felt(reference),   felt(x_down) = felt(reference) / (1 + w0).
///
/// If the device has a viscosity of its own, the step down is the larger one. If nothing feels
/// as weak as needed, the step up alone counts. Throws like `median_weber_fraction`.
[[nodiscard]] double median_curve_fraction(const Laboratory& laboratory, const Block& block,
                                           const core::ForceMap* map = nullptr);

}  // namespace jnd::experiments
