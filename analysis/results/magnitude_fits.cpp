#include "analysis/results/magnitude_fits.h"
#include "analysis/words/said.h"

#include <cmath>

namespace jnd::analysis {
namespace {

constexpr double kRatioPerPercent = 0.01;

std::optional<double> reciprocal(const std::optional<double>& value) {
  if (!value || !(*value > 0.0)) return std::nullopt;
  const double result = 1.0 / *value;
  return std::isfinite(result) ? std::optional(result) : std::nullopt;
}

}  // namespace

PowerFit fit_estimation(const Means& magnitude_at_intensity, PowerMethod method,
                        Solver solver) {
  std::vector<Magnitude> rows;
  for (const auto& [intensity, magnitude] : magnitude_at_intensity) {
    rows.push_back({intensity, magnitude});
  }
  return fit_power(rows, method, solver);
}

PowerFit fit_production(const Means& intensity_at_target, PowerMethod method, Solver solver) {
  std::vector<Magnitude> rows;
  for (const auto& [target_percent, intensity] : intensity_at_target) {
    rows.push_back({intensity, target_percent * kRatioPerPercent});
  }
  return fit_power(rows, method, solver);
}

PowerFit fit_log_estimation(const Means& log_magnitude_at_intensity) {
  Means magnitudes;
  for (const auto& [intensity, log_magnitude] : log_magnitude_at_intensity) {
    magnitudes[intensity] = std::exp(log_magnitude);
  }
  return fit_estimation(magnitudes, PowerMethod::kLogLog, Solver::kNewton);
}

PowerFit fit_log_production(const Means& log_intensity_at_target) {
  Means intensities;
  for (const auto& [target_percent, log_intensity] : log_intensity_at_target) {
    intensities[target_percent] = std::exp(log_intensity);
  }
  return fit_production(intensities, PowerMethod::kLogLog, Solver::kNewton);
}

PowerFit fit_intensity_on_magnitude(const std::vector<Produced>& rows) {
  std::vector<Magnitude> swapped;
  for (const Produced& row : rows) {
    swapped.push_back({row.target_ratio, std::exp(row.log_intensity)});
  }
  const PowerFit line = fit_power(swapped, PowerMethod::kLogLog);
  PowerFit turned{.status = FitStatus::kDegenerate,
                  .reason = line.reason,
                  .method = PowerMethod::kLogLog,
                  .num_rows = line.num_rows};
  if (line.status != FitStatus::kOk) return turned;
  const std::optional<double> a = reciprocal(line.a);
  if (!a) {
    turned.reason = said("the intensities set do not rise with the target");
    return turned;
  }
  const double log_k = -std::log(*line.k) * *a;
  if (!(std::fabs(log_k) < 700.0)) {
    turned.reason = said("k or a exceeds the range of numbers");
    return turned;
  }
  turned.status = FitStatus::kOk;
  turned.reason.clear();
  turned.k = std::exp(log_k);
  turned.a = a;
  turned.r_squared = line.r_squared;
  turned.is_exact = line.is_exact;
  turned.no_interval = line.no_interval;
  // The upper end of d gives the lower end of a. A lower end of d at 0 or below leaves the
  // upper end of a open.
  turned.a_ci95 = {reciprocal(line.a_ci95.high), reciprocal(line.a_ci95.low)};
  return turned;
}

PowerFit fit_own_intensity_on_magnitude(const MagnitudeAnswers& intensities_at_target) {
  std::vector<Produced> rows;
  for (const auto& [target_percent, logs] :
       log_answers(intensities_at_target, ZeroRule::kHalfSmallest).logs) {
    for (const double log_intensity : logs) {
      rows.push_back({target_percent * kRatioPerPercent, log_intensity});
    }
  }
  return fit_intensity_on_magnitude(rows);
}

core::PowerFunction geometric_mean_of(const core::PowerFunction& first,
                                      const core::PowerFunction& second) {
  return {.k = std::sqrt(first.k) * std::sqrt(second.k), .a = 0.5 * (first.a + second.a)};
}

}  // namespace jnd::analysis
