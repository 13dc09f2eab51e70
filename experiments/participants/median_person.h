#pragma once

#include "core/media/force_map.h"
#include "experiments/participants/laboratory.h"
#include "experiments/study/study.h"

namespace jnd::experiments {

// What estimates from a simulated laboratory should come to, if they had no noise.

/// The laboratory with its median person alone, who reads without noise and never lapses,
/// learns, tires or looks twice. What is systematic stays: shrinking toward the range's centre,
/// round numbers, the pull of the starting value and of the answer before.
[[nodiscard]] Laboratory without_noise(Laboratory laboratory);

/// The Weber fraction of the median person in a block with a reference, in its varied quantity:
/// the relative step that is felt as a factor 1 + w0 of the total damping,
///
///     felt(reference (1 + w)) = (1 + w0) felt(reference),
///
/// which for a viscous fluid of damping c x on a device of viscosity b is w0 (1 + b / (c
/// reference)); of a solid its own for stiffness. Lapses, learning and fatigue, which make
/// answers coarser, are not in it. Throws `Error` for a block without a reference > 0.
[[nodiscard]] double median_weber_fraction(const Laboratory& laboratory, const Block& block,
                                           const core::ForceMap* map = nullptr);

/// What a curve that is even in ln of the intensity has for it, as fitted ones are: half the
/// distance in ln between where the median person is felt right in 84.13 % below and above the
/// reference,
///
///     ln(1 + w) = (ln(x_up / reference) + ln(reference / x_down)) / 2,
///     felt(x_up) = (1 + w0) felt(reference),   felt(x_down) = felt(reference) / (1 + w0).
///
/// A device with a viscosity of its own makes the step down the larger one. The step up alone
/// where nothing is felt as that little. Throws as `median_weber_fraction`.
[[nodiscard]] double median_curve_fraction(const Laboratory& laboratory, const Block& block,
                                           const core::ForceMap* map = nullptr);

}  // namespace jnd::experiments
