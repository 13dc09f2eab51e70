#include "analysis/fits/power_fit.h"

#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>

#include "core/require.h"

namespace jnd::analysis {
namespace {

constexpr std::string_view kTooFew =
    "too few rows: a power law needs two different intensities > 0";
constexpr std::string_view kAllZero = "all magnitudes are 0: no k > 0 fits";
constexpr std::string_view kNotPositive =
    "no k > 0 fits better than magnitudes of 0 everywhere";
constexpr std::string_view kSteep =
    "only the highest intensity's magnitude counts: the exponent grows without bound";
constexpr std::string_view kFalling =
    "only the lowest intensity's magnitude counts: the exponent falls without bound";
constexpr std::string_view kOutOfRange = "k or a exceeds the range of numbers";

/// Rows with I > 0, intensities as t = (ln I - origin) / unit, which lies in [-1, 1]; with
/// b = a unit and c = k exp(a origin), S = c exp(b t). The other rows are predicted as 0.
struct ScaledRows {
  double origin = 0.0, unit = 1.0;
  double smallest_gap = std::numeric_limits<double>::infinity();
  std::vector<double> t, magnitude;
  double zero_squares = 0.0;  ///< Of the magnitudes at intensity 0.
};

/// The best c for one b, what is left over, and its derivatives in b, all of the sum of squares
/// q(b) = sum S^2 - N^2 / D with N = sum S e, D = sum e^2, e = exp(b (t - top)).
struct Profile {
  double value, slope, curvature, log_scale, best_c;
};

Profile profile(const ScaledRows& rows, double b) {
  const double top = b >= 0.0 ? 1.0 : -1.0;  // So that no exponential overflows.
  double n0 = 0.0, n1 = 0.0, n2 = 0.0, d0 = 0.0, d1 = 0.0, d2 = 0.0;
  for (std::size_t row = 0; row < rows.t.size(); ++row) {
    const double t = rows.t[row] - top;
    const double e = std::exp(b * t);
    const double s = rows.magnitude[row] * e;
    n0 += s;
    n1 += s * t;
    n2 += s * t * t;
    d0 += e * e;
    d1 += 2.0 * e * e * t;
    d2 += 4.0 * e * e * t * t;
  }
  const double c = n0 / d0;
  double value = rows.zero_squares;
  for (std::size_t row = 0; row < rows.t.size(); ++row) {
    const double residual = rows.magnitude[row] - c * std::exp(b * (rows.t[row] - top));
    value += residual * residual;
  }
  const double c_slope = (n1 - c * d1) / d0;
  // q = const - c N: q' = -(2 c N' - c^2 D'), q'' = -(2 c' N' + 2 c N'' - 2 c c' D' - c^2 D'').
  return {
      .value = value,
      .slope = -(2.0 * c * n1 - c * c * d1),
      .curvature = -(2.0 * c_slope * n1 + 2.0 * c * n2 - 2.0 * c * c_slope * d1 - c * c * d2),
      .log_scale = -b * top,
      .best_c = c};
}

/// Sum of squares as the exponent goes to +- infinity: the rows at that end at their mean (or
/// at 0 if that is negative), all others predicted as 0.
double limit(const ScaledRows& rows, double end) {
  double sum = 0.0, squares = 0.0, num_rows = 0.0;
  for (std::size_t row = 0; row < rows.t.size(); ++row) {
    squares += rows.magnitude[row] * rows.magnitude[row];
    if (rows.t[row] != end) continue;
    sum += rows.magnitude[row];
    num_rows += 1.0;
  }
  return rows.zero_squares + squares - (sum > 0.0 ? sum * sum / num_rows : 0.0);
}

/// The minimum between two values of b where the slope changes sign from - to +, by Newton's
/// method kept inside by halving.
double refined(const ScaledRows& rows, double low, double high) {
  double b = 0.5 * (low + high);
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Profile here = profile(rows, b);
    (here.slope < 0.0 ? low : high) = b;
    double next = b - here.slope / here.curvature;
    if (!(here.curvature > 0.0 && next > low && next < high)) next = 0.5 * (low + high);
    const double step = std::fabs(next - b);
    b = next;
    if (step <= 1e-15 * std::max(1.0, std::fabs(b))) break;
  }
  return b;
}

ScaledRows scaled(const std::vector<Magnitude>& data) {
  ScaledRows rows;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Magnitude& row : data) {
    if (row.intensity == 0.0) {
      rows.zero_squares += row.magnitude * row.magnitude;
      continue;
    }
    rows.t.push_back(std::log(row.intensity));
    rows.magnitude.push_back(row.magnitude);
    low = std::min(low, rows.t.back());
    high = std::max(high, rows.t.back());
  }
  if (!(high > low)) {
    rows.unit = 0.0;
    return rows;
  }
  rows.origin = 0.5 * (low + high);
  rows.unit = 0.5 * (high - low);
  for (double& t : rows.t) {
    t = t == low ? -1.0 : t == high ? 1.0 : (t - rows.origin) / rows.unit;
  }
  std::vector<double> ascending = rows.t;
  std::sort(ascending.begin(), ascending.end());
  for (std::size_t row = 1; row < ascending.size(); ++row) {
    const double gap = ascending[row] - ascending[row - 1];
    if (gap > 0.0) rows.smallest_gap = std::min(rows.smallest_gap, gap);
  }
  return rows;
}

/// Exponents to look between for minima, denser near 0, to where only one row counts.
std::vector<double> grid(const ScaledRows& rows) {
  const double steepest = 45.0 / std::max(rows.smallest_gap, 1e-3);
  std::vector<double> values = {0.0};
  for (double b = 0.02; b < steepest; b *= 1.15) {
    values.push_back(b);
    values.push_back(-b);
  }
  std::sort(values.begin(), values.end());
  return values;
}

/// What the two methods share once k, a, the sums and the covariance are known.
void fill(PowerFit& fit, double log_k, double a, double log_k_error, double a_error) {
  fit.status = FitStatus::kOk;
  fit.reason.clear();
  fit.k = std::exp(log_k);
  fit.a = a;
  if (fit.num_rows <= 2) return;
  fit.k_standard_error = *fit.k * log_k_error;
  fit.a_standard_error = a_error;
  const double t = boost::math::quantile(
      boost::math::students_t(static_cast<double>(fit.num_rows - 2)), 0.975);
  fit.k_ci95 = {std::exp(log_k - t * log_k_error), std::exp(log_k + t * log_k_error)};
  fit.a_ci95 = {a - t * a_error, a + t * a_error};
}

/// Variances of intercept and slope of a line over x per unit of variance, the intercept's
/// column being `weight` and the slope's weight x: (J^T J)^-1.
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

double sum_about_mean(const std::vector<double>& values) {
  double mean = 0.0;
  for (const double value : values) mean += value;
  mean /= static_cast<double>(values.size());
  double sum = 0.0;
  for (const double value : values) sum += (value - mean) * (value - mean);
  return sum;
}

void fit_nonlinear(PowerFit& fit, const std::vector<Magnitude>& data) {
  const ScaledRows rows = scaled(data);
  fit.num_rows = static_cast<int>(data.size());
  if (rows.t.size() < 2 || rows.unit == 0.0) {
    fit.reason = kTooFew;
    return;
  }
  double squares = 0.0;
  for (const double magnitude : rows.magnitude) squares += magnitude * magnitude;
  if (squares == 0.0) {
    fit.reason = kAllZero;
    return;
  }
  const std::vector<double> places = grid(rows);
  double best_b = 0.0, best = std::numeric_limits<double>::infinity(), best_c = 0.0,
         log_scale = 0.0;
  Profile left = profile(rows, places.front());
  for (std::size_t place = 1; place < places.size(); ++place) {
    const Profile right = profile(rows, places[place]);
    if (left.slope < 0.0 && right.slope >= 0.0) {
      const double b = refined(rows, places[place - 1], places[place]);
      const Profile found = profile(rows, b);
      if (found.best_c > 0.0 && found.value < best) {
        best = found.value;
        best_b = b;
        best_c = found.best_c;
        log_scale = found.log_scale;
      }
    }
    left = right;
  }
  const double rising = limit(rows, 1.0), falling = limit(rows, -1.0);
  const double nothing = squares + rows.zero_squares;
  const double bound = std::min({rising, falling, nothing});
  if (!(best < bound - 1e-14 * nothing)) {
    fit.reason = bound == nothing ? kNotPositive : rising < falling ? kSteep : kFalling;
    return;
  }
  const double a = best_b / rows.unit;
  const double log_k = std::log(best_c) + log_scale - a * rows.origin;
  if (!(std::fabs(log_k) < 700.0)) {
    fit.reason = kOutOfRange;
    return;
  }
  // The Jacobian in (ln k, a) is (S, S ln I): a weighted line.
  std::vector<double> predicted, log_intensity, magnitudes;
  for (const Magnitude& row : data) {
    magnitudes.push_back(row.magnitude);
    if (row.intensity == 0.0) continue;
    log_intensity.push_back(std::log(row.intensity));
    predicted.push_back(std::exp(log_k + a * log_intensity.back()));
  }
  const LineVariance variance = line_variance(predicted, log_intensity);
  const double residual_variance = best / (fit.num_rows - 2);
  fill(fit, log_k, a, std::sqrt(residual_variance * variance.intercept),
       std::sqrt(residual_variance * variance.slope));
  const double about_mean = sum_about_mean(magnitudes);
  if (about_mean > 0.0) fit.r_squared = 1.0 - best / about_mean;
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
    fit.reason = kTooFew;
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
    fit.reason = kOutOfRange;
    return;
  }
  double squares = 0.0;
  for (std::size_t row = 0; row < x.size(); ++row) {
    const double residual = y[row] - log_k - a * x[row];
    squares += residual * residual;
  }
  const LineVariance variance = line_variance(std::vector<double>(x.size(), 1.0), x);
  const double residual_variance = squares / (fit.num_rows - 2);
  fill(fit, log_k, a, std::sqrt(residual_variance * variance.intercept),
       std::sqrt(residual_variance * variance.slope));
  const double about_mean = sum_about_mean(y);
  if (about_mean > 0.0) fit.r_squared = 1.0 - squares / about_mean;
}

}  // namespace

PowerFit fit_power(const std::vector<Magnitude>& data, PowerMethod method) {
  for (const Magnitude& row : data) {
    core::require(row.intensity >= 0.0 && std::isfinite(row.intensity), "intensity",
                  "a finite number >= 0", row.intensity);
    core::require(std::isfinite(row.magnitude), "magnitude", "a finite number", row.magnitude);
  }
  PowerFit fit;
  fit.method = method;
  fit.status = FitStatus::kDegenerate;
  method == PowerMethod::kNonlinear ? fit_nonlinear(fit, data) : fit_logarithms(fit, data);
  return fit;
}

PowerFit power_between(const core::PowerFunction& first, const core::PowerFunction& second,
                       const std::vector<double>& intensities) {
  std::vector<Magnitude> rows;
  for (const double intensity : intensities) {
    rows.push_back({intensity, first.magnitude(intensity)});
    rows.push_back({intensity, second.magnitude(intensity)});
  }
  return fit_power(rows, PowerMethod::kNonlinear);
}

}  // namespace jnd::analysis
