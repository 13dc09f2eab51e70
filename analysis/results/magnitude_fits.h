#pragma once

#include "analysis/data/magnitude_means.h"
#include "analysis/fits/power_fit.h"

namespace jnd::analysis {

/// Stevens' power law through mean magnitudes at intensities.
[[nodiscard]] PowerFit fit_estimation(const Means& magnitude_at_intensity, PowerMethod method,
                                      Solver solver);

/// The power law through mean intensities that were set for targets in percent, S on I as in
/// the thesis. The residuals are those of the magnitudes, although the intensities varied.
[[nodiscard]] PowerFit fit_production(const Means& intensity_at_target, PowerMethod method,
                                      Solver solver);

/// A line through the logarithms of means. The argument holds logarithms of the means.
[[nodiscard]] PowerFit fit_log_estimation(const Means& log_magnitude_at_intensity);
[[nodiscard]] PowerFit fit_log_production(const Means& log_intensity_at_target);

/// The regression of I on S. A production answers with an intensity, so its logarithm is fitted
/// over that of the target. The line I = c S^d is then inverted: k = c^(-1/d), a = 1/d. If d
/// cannot be distinguished from 0, the interval of a has an open end. k has no interval. `rows`
/// holds the target's ratio and the logarithm of the intensity, for each answer or mean. The
/// status is also `degenerate` if d is not > 0, which means that higher intensities were set
/// for lower targets.
struct Produced {
  double target_ratio = 0.0;  ///< > 0
  double log_intensity = 0.0;
};
[[nodiscard]] PowerFit fit_intensity_on_magnitude(const std::vector<Produced>& rows);

/// The same regression through every answer of one participant, with intensities set for
/// targets in percent. Intensities of 0 count as half the smallest one above 0.
[[nodiscard]] PowerFit fit_own_intensity_on_magnitude(
    const MagnitudeAnswers& intensities_at_target);

/// The power law whose magnitude at every intensity is the geometric mean of two others: k =
/// sqrt(k1 k2), a = (a1 + a2) / 2.
[[nodiscard]] core::PowerFunction geometric_mean_of(const core::PowerFunction& first,
                                                    const core::PowerFunction& second);

}  // namespace jnd::analysis
