#include "analysis/fits/power_nonlinear.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/fits/ceres_descent.h"

namespace jnd::analysis {
namespace {

constexpr std::string_view kAllZero = "all magnitudes are 0: no k > 0 fits";
constexpr std::string_view kNotPositive =
    "no k > 0 fits better than magnitudes of 0 everywhere";
constexpr std::string_view kSteep =
    "only the highest intensity's magnitude counts: the exponent grows without bound";
constexpr std::string_view kFalling =
    "only the lowest intensity's magnitude counts: the exponent falls without bound";
constexpr std::string_view kLost = "the search for the optimum did not come to rest";

/// Scaled data. Intensities become t = (ln I - origin) / unit, which lies in [-1, 1]. With b =
/// a unit and c = k exp(a origin), the law is S = c exp(b t). Magnitudes are divided by the
/// largest one.
struct ScaledRows {
  double origin = 0.0, unit = 1.0, largest = 0.0;
  double smallest_gap = std::numeric_limits<double>::infinity();
  std::vector<double> t, magnitude;
};

/// The best c for one b, the remaining sum of squares, and its derivatives by b. The sum of
/// squares is q(b) = sum S^2 - N^2 / D with N = sum S e, D = sum e^2, e = exp(b (t - top)).
struct Profile {
  double value, slope, curvature, log_scale, best_c;
};

// Shifting t by this value keeps every exponential from overflowing.
double top_of(double b) { return b >= 0.0 ? 1.0 : -1.0; }

Profile profile(const ScaledRows& rows, double b) {
  const double top = top_of(b);
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
  double value = 0.0;
  for (std::size_t row = 0; row < rows.t.size(); ++row) {
    const double residual = rows.magnitude[row] - c * std::exp(b * (rows.t[row] - top));
    value += residual * residual;
  }
  const double c_slope = (n1 - c * d1) / d0;
  // q = const - c N has the derivatives q' = -(2 c N' - c^2 D') and q'' = -(2 c' N' + 2 c N'' -
  // 2 c c' D' - c^2 D'').
  return {
      .value = value,
      .slope = -(2.0 * c * n1 - c * c * d1),
      .curvature = -(2.0 * c_slope * n1 + 2.0 * c * n2 - 2.0 * c * c_slope * d1 - c * c * d2),
      .log_scale = -b * top,
      .best_c = c};
}

/// The sum of squares as the exponent goes to plus or minus infinity. The rows at that end are
/// predicted by their mean (by 0 if it is negative), and all others by 0.
double limit(const ScaledRows& rows, double end) {
  double sum = 0.0, num_rows = 0.0;
  for (std::size_t row = 0; row < rows.t.size(); ++row) {
    if (rows.t[row] != end) continue;
    sum += rows.magnitude[row];
    num_rows += 1.0;
  }
  const double mean = std::max(0.0, sum / num_rows);
  double squares = 0.0;
  for (std::size_t row = 0; row < rows.t.size(); ++row) {
    const double residual = rows.magnitude[row] - (rows.t[row] == end ? mean : 0.0);
    squares += residual * residual;
  }
  return squares;
}

ScaledRows scaled(const std::vector<Magnitude>& data) {
  ScaledRows rows;
  for (const Magnitude& row : data) {
    rows.largest = std::max(rows.largest, std::fabs(row.magnitude));
  }
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Magnitude& row : data) {
    const double magnitude = rows.largest > 0.0 ? row.magnitude / rows.largest : 0.0;
    rows.t.push_back(std::log(row.intensity));
    rows.magnitude.push_back(magnitude);
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

/// The exponents between which minima are sought. They are denser near 0, and end where only
/// one row counts.
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

/// Two exponents between which the sum of squares turns from falling to rising.
struct Bracket {
  double low, high;
};

/// The minimum within the bracket, by Newton's method over b. Halving keeps the search inside.
double newton_exponent(const ScaledRows& rows, Bracket bracket, double start) {
  double b = start;
  for (int iteration = 0; iteration < 200; ++iteration) {
    const Profile here = profile(rows, b);
    (here.slope < 0.0 ? bracket.low : bracket.high) = b;
    double next = b - here.slope / here.curvature;
    if (!(here.curvature > 0.0 && next > bracket.low && next < bracket.high)) {
      next = 0.5 * (bracket.low + bracket.high);
    }
    const double step = std::fabs(next - b);
    b = next;
    if (step <= 1e-15 * std::max(1.0, std::fabs(b))) break;
  }
  return b;
}

/// The b at which Ceres comes to rest over (ln c, b). Here c is the law's value at the end
/// where the law is largest.
double ceres_exponent(const ScaledRows& rows, double start) {
  const double top = top_of(start);
  SquaresProblem problem;
  problem.num_residuals = static_cast<int>(rows.t.size());
  problem.evaluate = [&](std::span<const double> x, std::span<double> residuals,
                         std::span<double> jacobian) {
    bool finite = true;
    for (std::size_t row = 0; row < rows.t.size(); ++row) {
      const double t = rows.t[row] - top;
      const double predicted = std::exp(x[0] + x[1] * t);
      finite = finite && std::isfinite(predicted);
      residuals[row] = predicted - rows.magnitude[row];
      if (jacobian.empty()) continue;
      jacobian[2 * row] = predicted;
      jacobian[2 * row + 1] = predicted * t;
    }
    return finite;
  };
  return ceres_minimum(problem, {std::log(profile(rows, start).best_c), start})[1];
}

/// A minimum, and whether all solvers agree on it.
struct Found {
  double b = 0.0;
  Profile at{.value = std::numeric_limits<double>::infinity()};
  bool agreed = false;
};

/// The minimum that Ceres finds, with its last digits by Newton's method; or the minimum of
/// Newton's method alone.
Found minimum_from(const ScaledRows& rows, const Bracket& bracket, double start,
                   Solver solver) {
  constexpr double kNear = 1e-4, kFlat = 1e-9;
  const double reached = solver == Solver::kCeres ? ceres_exponent(rows, start) : start;
  const bool inside = reached >= bracket.low && reached <= bracket.high;
  Found found;
  found.b = newton_exponent(rows, bracket, inside ? reached : start);
  found.at = profile(rows, found.b);
  found.agreed =
      solver == Solver::kNewton ||
      std::fabs(reached - found.b) <= kNear * (1.0 + std::fabs(found.b)) ||
      std::fabs(profile(rows, reached).value - found.at.value) <= kFlat * found.at.value;
  return found;
}

Found lowest_minimum(const ScaledRows& rows, Solver solver) {
  const std::vector<double> places = grid(rows);
  Found best;
  Bracket around{};
  Profile left = profile(rows, places.front());
  for (std::size_t place = 1; place < places.size(); ++place) {
    const Bracket bracket{places[place - 1], places[place]};
    const Profile right = profile(rows, bracket.high);
    const double start = 0.5 * (bracket.low + bracket.high);
    if (left.slope < 0.0 && right.slope >= 0.0 && profile(rows, start).best_c > 0.0) {
      const Found found = minimum_from(rows, bracket, start, solver);
      if (found.at.best_c > 0.0 && found.at.value < best.at.value) {
        best = found;
        around = bracket;
      }
    }
    left = right;
  }
  if (!best.agreed && std::isfinite(best.at.value)) {
    best = minimum_from(rows, around, best.b, solver);  // Checks whether Ceres stays there.
  }
  return best;
}

PowerMinimum none(std::string_view reason) { return {FitStatus::kDegenerate, reason}; }

}  // namespace

PowerMinimum power_minimum(const std::vector<Magnitude>& data, Solver solver) {
  const ScaledRows rows = scaled(data);
  if (rows.t.size() < 2 || rows.unit == 0.0) return none(kTooFewRows);
  double squares = 0.0;
  for (const double magnitude : rows.magnitude) squares += magnitude * magnitude;
  if (squares == 0.0) return none(kAllZero);

  const Found best = lowest_minimum(rows, solver);
  const double rising = limit(rows, 1.0), falling = limit(rows, -1.0);
  const double bound = std::min({rising, falling, squares});
  if (!(best.at.value < bound * (1.0 - 1e-13) - 1e-28)) {
    return none(bound == squares ? kNotPositive : rising < falling ? kSteep : kFalling);
  }
  if (!best.agreed) return {FitStatus::kNotConverged, kLost};
  const double a = best.b / rows.unit;
  const double log_k =
      std::log(best.at.best_c) + std::log(rows.largest) + best.at.log_scale - a * rows.origin;
  if (!(std::fabs(log_k) < 700.0)) return none(kPowerOutOfRange);
  return {FitStatus::kOk, "", log_k, a, rows.largest, best.at.value};
}

}  // namespace jnd::analysis
