#include "analysis/fits/power_fit.h"

#include <algorithm>
#include <cmath>

#include "analysis/fits/power_nonlinear.h"
#include "analysis/statistics/distributions.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr int kFewestRowsOfInterval = 4;
/// A residual below this counts as none, because rounding leaves about as much. The unit is the
/// largest magnitude, or the natural logarithm.
constexpr double kNoResidual = 1e-9;

/// The variances of the intercept and slope of a line over x, for a residual variance of 1: the
/// diagonal of (J^T J)^-1. The intercept's column of J is `weight`, and the slope's column is
/// weight x.
struct LineVariance {
  double intercept, slope;
};

LineVariance line_variance(const std::vector<double>& weight, const std::vector<double>& x) {
  double sum = 0.0, sum_x = 0.0;
  for (std::size_t row = 0; row < x.size(); ++row) {
    sum += weight[row] * weight[row];
    sum_x += weight[row] * weight[row] * x[row];
  }
  const double mean = sum_x / sum;
  double spread = 0.0;
  for (std::size_t row = 0; row < x.size(); ++row) {
    spread += weight[row] * weight[row] * (x[row] - mean) * (x[row] - mean);
  }
  return {.intercept = 1.0 / sum + mean * mean / spread, .slope = 1.0 / spread};
}

/// The sum of squares about the mean. It is exactly 0 if all values are equal, whatever
/// rounding makes of their mean.
double sum_about_mean(const std::vector<double>& values) {
  if (std::all_of(values.begin(), values.end(), [&](double v) { return v == values[0]; })) {
    return 0.0;
  }
  double mean = 0.0;
  for (const double value : values) mean += value;
  mean /= static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum;
}

std::optional<double> in_range(double value, bool positive) {
  const bool holds = std::isfinite(value) && (!positive || value > 0.0);
  return holds ? std::optional(value) : std::nullopt;
}

/// Fills in what both methods share once k and a are known. `squares` is the sum of squared
/// residuals of `values`.
void fill(PowerFit& fit, double log_k, double a, const LineVariance& variance, double squares,
          const std::vector<double>& values) {
  fit.status = FitStatus::kOk;
  fit.reason.clear();
  fit.k = std::exp(log_k);
  const double about_mean = sum_about_mean(values);
  fit.a = about_mean > 0.0 ? a : 0.0;  // For equal values rounding would leave a tiny exponent.
  if (about_mean > 0.0) fit.r_squared = 1.0 - squares / about_mean;
  if (fit.num_rows <= 2) {
    fit.no_interval = "no degree of freedom is left";
    return;
  }
  const double residual_variance = squares / (fit.num_rows - 2);
  const double log_k_error = std::sqrt(residual_variance * variance.intercept);
  const double a_error = std::sqrt(residual_variance * variance.slope);
  fit.k_standard_error = in_range(*fit.k * log_k_error, false);
  fit.a_standard_error = in_range(a_error, false);
  if (std::sqrt(squares / fit.num_rows) <= kNoResidual) {
    fit.is_exact = true;
    fit.no_interval = "the power law passes through every row";
    return;
  }
  if (fit.num_rows < kFewestRowsOfInterval) {
    fit.no_interval = "one degree of freedom is too few";
    return;
  }
  const double t = student_t_quantile(0.975, static_cast<double>(fit.num_rows - 2));
  fit.k_ci95 = {in_range(std::exp(log_k - t * log_k_error), true),
                in_range(std::exp(log_k + t * log_k_error), true)};
  fit.a_ci95 = {in_range(a - t * a_error, false), in_range(a + t * a_error, false)};
}

/// At intensity 0 the magnitude does not depend on k and a: it is 0 for every a > 0.
constexpr std::string_view kAtZero =
    "the intensity is 0, where k I^a is 0 for every k and every a > 0";

void fit_nonlinear(PowerFit& fit, const std::vector<Magnitude>& all, Solver solver) {
  std::vector<Magnitude> data;
  for (std::size_t row = 0; row < all.size(); ++row) {
    if (all[row].intensity > 0.0) {
      data.push_back(all[row]);
    } else {
      fit.excluded.push_back({row, all[row], std::string(kAtZero)});
    }
  }
  fit.num_rows = static_cast<int>(data.size());
  if (std::ranges::any_of(data, [](const Magnitude& row) { return row.magnitude < 0.0; })) {
    fit.warnings.emplace_back("a magnitude lies below 0, which no power law reaches");
  }
  const PowerMinimum minimum = power_minimum(data, solver);
  fit.status = minimum.status;
  fit.reason = minimum.reason;
  if (minimum.status != FitStatus::kOk) return;
  // The Jacobian in (ln k, a) is (S, S ln I), which is that of a weighted line.
  std::vector<double> predicted, log_intensity, magnitudes;
  for (const Magnitude& row : data) {
    magnitudes.push_back(row.magnitude / minimum.largest);
    log_intensity.push_back(std::log(row.intensity));
    predicted.push_back(std::exp(minimum.log_k + minimum.a * log_intensity.back()) /
                        minimum.largest);
  }
  fill(fit, minimum.log_k, minimum.a, line_variance(predicted, log_intensity),
       minimum.sum_of_squares, magnitudes);
}

void fit_logarithms(PowerFit& fit, const std::vector<Magnitude>& data) {
  std::vector<double> x, y;
  for (std::size_t row = 0; row < data.size(); ++row) {
    const bool no_intensity = !(data[row].intensity > 0.0);
    if (no_intensity || !(data[row].magnitude > 0.0)) {
      fit.excluded.push_back({row, data[row],
                              no_intensity ? "the intensity has no logarithm: expected > 0"
                                           : "the magnitude has no logarithm: expected > 0"});
      continue;
    }
    x.push_back(std::log(data[row].intensity));
    y.push_back(std::log(data[row].magnitude));
  }
  fit.num_rows = static_cast<int>(x.size());
  if (x.size() < 2 || std::all_of(x.begin(), x.end(), [&](double v) { return v == x[0]; })) {
    fit.reason = kTooFewRows;
    return;
  }
  double mean_x = 0.0, mean_y = 0.0;
  for (std::size_t row = 0; row < x.size(); ++row) {
    mean_x += x[row] / static_cast<double>(x.size());
    mean_y += y[row] / static_cast<double>(x.size());
  }
  double xx = 0.0, xy = 0.0;
  for (std::size_t row = 0; row < x.size(); ++row) {
    xx += (x[row] - mean_x) * (x[row] - mean_x);
    xy += (x[row] - mean_x) * (y[row] - mean_y);
  }
  const double a = xy / xx, log_k = mean_y - a * mean_x;
  if (!(std::fabs(log_k) < 700.0)) {
    fit.reason = kPowerOutOfRange;
    return;
  }
  double squares = 0.0;
  for (std::size_t row = 0; row < x.size(); ++row) {
    const double residual = y[row] - log_k - a * x[row];
    squares += residual * residual;
  }
  fill(fit, log_k, a, line_variance(std::vector<double>(x.size(), 1.0), x), squares, y);
}

}  // namespace

PowerFit fit_power(const std::vector<Magnitude>& data, PowerMethod method, Solver solver) {
  for (const Magnitude& row : data) {
    core::require_not_negative(row.intensity, "intensity");
    core::require(std::isfinite(row.magnitude), "magnitude", "a finite number", row.magnitude);
  }
  PowerFit fit;
  fit.method = method;
  fit.status = FitStatus::kDegenerate;
  fit.num_at_zero = static_cast<int>(std::ranges::count(data, 0.0, &Magnitude::intensity));
  method == PowerMethod::kNonlinear ? fit_nonlinear(fit, data, solver)
                                    : fit_logarithms(fit, data);
  return fit;
}

PowerFit power_between(const core::PowerFunction& first, const core::PowerFunction& second,
                       const std::vector<double>& intensities, Solver solver) {
  std::vector<Magnitude> rows;
  for (const double intensity : intensities) {
    if (intensity == 0.0) continue;
    rows.push_back({intensity, first.magnitude(intensity)});
    rows.push_back({intensity, second.magnitude(intensity)});
  }
  return fit_power(rows, PowerMethod::kNonlinear, solver);
}

}  // namespace jnd::analysis
