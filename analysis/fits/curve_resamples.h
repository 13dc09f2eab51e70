#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/fits/curve_fit.h"

namespace jnd::analysis {

/// Values of several quantities over redrawn answers: one list for each quantity, in the order
/// of the redraws. If a redraw has no optimum, its value is the limit that the quantity tends
/// to, such as a JND of 0 for a step. The same seed draws the same answers.
struct CurveResamples {
  std::vector<std::vector<double>> values;
  int num_degenerate = 0;
};
[[nodiscard]] CurveResamples resampled(const FoundCurve& fit, const CurveModel& model,
                                       const std::vector<CurveQuantity>& quantities,
                                       int num_redraws, BootstrapKind kind, std::uint64_t seed);

/// The acceleration of BCa for each quantity, from leaving out one answer at a time. It is
/// absent where there is no fit without one of the answers.
[[nodiscard]] std::vector<std::optional<double>> accelerations(
    const FoundCurve& fit, const CurveModel& model,
    const std::vector<CurveQuantity>& quantities);

}  // namespace jnd::analysis
