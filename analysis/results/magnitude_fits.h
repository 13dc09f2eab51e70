#pragma once

#include "analysis/data/magnitude_means.h"
#include "analysis/fits/power_fit.h"

namespace jnd::analysis {

/// Stevens' power law through means of magnitudes at intensities.
[[nodiscard]] PowerFit fit_estimation(const Means& magnitude_at_intensity, PowerMethod method,
                                      Solver solver);

/// The same through means of the intensities set for targets in percent, S on I as in the
/// thesis: the residuals are those of the magnitudes, though the intensities are what varied.
[[nodiscard]] PowerFit fit_production(const Means& intensity_at_target, PowerMethod method,
                                      Solver solver);

/// A line through the logarithms of means: `log_magnitude_at_intensity` holds logarithms.
[[nodiscard]] PowerFit fit_log_estimation(const Means& log_magnitude_at_intensity);
[[nodiscard]] PowerFit fit_log_production(const Means& log_intensity_at_target);

/// The regression of I on S: production answers with an intensity, so its logarithm is fitted
/// over that of the target, and the line I = c S^d turned around, k = c^(-1/d), a = 1/d.
/// Where d is not distinguished from 0, the interval of a has an open end; k has none.
/// `rows`: of each answer or mean, the target's ratio and the intensity's logarithm.
/// `degenerate` also where d is not > 0: more was set for less.
struct Produced {
  double target_ratio = 0.0;  ///< > 0
  double log_intensity = 0.0;
};
[[nodiscard]] PowerFit fit_intensity_on_magnitude(const std::vector<Produced>& rows);

/// The same through every answer of one participant: the intensities set for targets in
/// percent, those of 0 as half the smallest above 0.
[[nodiscard]] PowerFit fit_own_intensity_on_magnitude(
    const MagnitudeAnswers& intensities_at_target);

/// At every intensity the geometric mean of two power laws' magnitudes: k = sqrt(k1 k2),
/// a = (a1 + a2) / 2.
[[nodiscard]] core::PowerFunction geometric_mean_of(const core::PowerFunction& first,
                                                    const core::PowerFunction& second);

}  // namespace jnd::analysis
