#include "analysis/commissioning/force_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>

#include "analysis/statistics/distributions.h"
#include "core/error.h"

namespace jnd::analysis {
namespace {

constexpr double kGravity_m_per_s2 = 9.80665;
/// Directions whose |cosine| is larger count as one line.
constexpr double kAlongRatio = 0.99;
/// Speeds that differ by this factor count as different.
constexpr double kOtherSpeedRatio = 1.3;

/// Ordinary least squares.
struct Regression {
  Eigen::VectorXd coefficients;
  Eigen::MatrixXd covariance;
  double squares = 0.0;  ///< The remaining sum of squares.
  double degrees_of_freedom = 0.0;

  [[nodiscard]] double residual() const { return std::sqrt(squares / degrees_of_freedom); }
  [[nodiscard]] double error(Eigen::Index i) const { return std::sqrt(covariance(i, i)); }
};

/// Absent if the rows do not determine the coefficients.
std::optional<Regression> regression(const Eigen::MatrixXd& rows,
                                     const Eigen::VectorXd& values) {
  if (rows.rows() <= rows.cols()) return std::nullopt;
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(rows);
  if (solver.rank() < rows.cols()) return std::nullopt;
  Regression fit;
  fit.coefficients = solver.solve(values);
  fit.squares = (values - rows * fit.coefficients).squaredNorm();
  fit.degrees_of_freedom = static_cast<double>(rows.rows() - rows.cols());
  fit.covariance = fit.squares / fit.degrees_of_freedom * (rows.transpose() * rows).inverse();
  return fit;
}

/// A regression with one row for each of these ways. The value is the commanded force without
/// that for the mass.
template <typename RowOf>
std::optional<Regression> regression_over(const std::vector<GuidedWay>& ways,
                                          Eigen::Index num_coefficients,
                                          double mass_per_gain_kg, const RowOf& row_of) {
  Eigen::MatrixXd rows(static_cast<Eigen::Index>(ways.size()), num_coefficients);
  Eigen::VectorXd values(static_cast<Eigen::Index>(ways.size()));
  for (Eigen::Index i = 0; i < values.size(); ++i) {
    const GuidedWay& way = ways[static_cast<std::size_t>(i)];
    rows.row(i) = row_of(way);
    values[i] = way.commanded_n - mass_per_gain_kg * way.acceleration_m_per_s2;
  }
  return regression(rows, values);
}

[[noreturn]] void refuse_ways() {
  throw core::Error(
      "force: expected ways both to and fro along three axes, at two speeds and with two "
      "loads, "
      "found too few to tell gain, weight, friction and damping apart");
}

/// A load must be carried and accelerated.
double load_along_n(const GuidedWay& way, const Eigen::Vector3d& up) {
  return way.load_n * (up.dot(way.direction) + way.acceleration_m_per_s2 / kGravity_m_per_s2);
}

/// The ways up and down with loads, and the ways without loads at the same speeds.
std::vector<GuidedWay> ways_of_loads(const std::vector<GuidedWay>& ways,
                                     const Eigen::Vector3d& up) {
  double slowest = std::numeric_limits<double>::infinity(), fastest = 0.0;
  for (const GuidedWay& way : ways) {
    if (way.load_n == 0.0) continue;
    slowest = std::min(slowest, way.speed_m_per_s);
    fastest = std::max(fastest, way.speed_m_per_s);
  }
  std::vector<GuidedWay> chosen;
  std::copy_if(ways.begin(), ways.end(), std::back_inserter(chosen), [&](const GuidedWay& way) {
    return std::abs(way.direction.dot(up)) > kAlongRatio &&
           way.speed_m_per_s > slowest / kOtherSpeedRatio &&
           way.speed_m_per_s < fastest * kOtherSpeedRatio;
  });
  return chosen;
}

/// The last one is used only if loads were lifted at more than one speed.
enum LoadCoefficient : Eigen::Index { kUpwards, kLoad, kOpposing, kOpposingSpeed };

/// `num_coefficients` is that of the regression.
Eigen::RowVectorXd load_row(const GuidedWay& way, const Eigen::Vector3d& up,
                            Eigen::Index num_coefficients) {
  Eigen::RowVector4d row(-way.direction.dot(up), load_along_n(way, up), way.path_ratio,
                         way.speed_m_per_s);
  return row.head(num_coefficients);
}

Eigen::Index num_load_coefficients(const std::vector<GuidedWay>& of_loads) {
  double slowest = std::numeric_limits<double>::infinity(), fastest = 0.0;
  for (const GuidedWay& way : of_loads) {
    slowest = std::min(slowest, way.speed_m_per_s);
    fastest = std::max(fastest, way.speed_m_per_s);
  }
  return fastest > kOtherSpeedRatio * slowest ? kOpposingSpeed + 1 : kOpposing + 1;
}

/// The standard deviation of the gains of single poses, divided by the gain of all poses.
double gain_spread_ratio(const std::vector<GuidedWay>& of_loads, const Eigen::Vector3d& up,
                         double mass_per_gain_kg, const Regression& whole) {
  struct Sums {
    double xx = 0.0, xy = 0.0;
  };
  std::map<int, Sums> poses;
  for (const GuidedWay& way : of_loads) {
    if (way.load_n == 0.0) continue;
    Eigen::VectorXd others = whole.coefficients;
    others[kLoad] = 0.0;
    const double x = load_along_n(way, up);
    const double y = way.commanded_n - mass_per_gain_kg * way.acceleration_m_per_s2 -
                     load_row(way, up, others.size()).dot(others);
    poses[way.pose].xx += x * x;
    poses[way.pose].xy += x * y;
  }
  std::vector<double> ratios;
  for (const auto& [pose, sums] : poses) {
    if (sums.xx > 0.0) ratios.push_back(sums.xy / sums.xx / whole.coefficients[kLoad]);
  }
  if (ratios.size() < 2) return 0.0;
  double mean = 0.0, squares = 0.0;
  for (const double ratio : ratios) mean += ratio / static_cast<double>(ratios.size());
  for (const double ratio : ratios) squares += (ratio - mean) * (ratio - mean);
  return std::sqrt(squares / static_cast<double>(ratios.size() - 1));
}

/// The ways without loads for each line. Lines are in the order of their first ways.
std::vector<std::vector<GuidedWay>> lines_of(const std::vector<GuidedWay>& ways) {
  std::vector<std::vector<GuidedWay>> lines;
  for (const GuidedWay& way : ways) {
    if (way.load_n != 0.0) continue;
    const auto line =
        std::find_if(lines.begin(), lines.end(), [&](const std::vector<GuidedWay>& known) {
          return std::abs(known.front().direction.dot(way.direction)) > kAlongRatio;
        });
    if (line == lines.end()) {
      lines.push_back({way});
    } else {
      line->push_back(way);
    }
  }
  return lines;
}

/// Damping and friction in commanded newtons.
struct Opposing {
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();  ///< The constant force along all lines.
  Measured damping, friction;
  double residual = 0.0;
  std::vector<Measured> damping_by_line;
  bool is_alike = true;
};

Opposing opposing_of(const std::vector<GuidedWay>& ways, double mass_per_gain_kg) {
  const std::vector<std::vector<GuidedWay>> lines = lines_of(ways);
  std::vector<GuidedWay> unloaded;
  for (const auto& line : lines) unloaded.insert(unloaded.end(), line.begin(), line.end());
  enum : Eigen::Index { kX, kY, kZ, kSpeed, kOne, kNumCommon };
  const auto common =
      regression_over(unloaded, kNumCommon, mass_per_gain_kg,
                      [](const GuidedWay& way) -> Eigen::Matrix<double, 1, kNumCommon> {
                        return {-way.direction.x(), -way.direction.y(), -way.direction.z(),
                                way.speed_m_per_s, way.path_ratio};
                      });
  if (!common) refuse_ways();
  const auto measured_at = [](const Regression& fit, Eigen::Index i) {
    return measured(fit.coefficients[i], fit.error(i), fit.degrees_of_freedom);
  };
  Opposing opposing{.offset = common->coefficients.head<3>(),
                    .damping = measured_at(*common, kSpeed),
                    .friction = measured_at(*common, kOne),
                    .residual = common->residual()};
  // Each line has a fit of its own, for the constant force along it, the speed, and the path
  // ratio.
  double squares = 0.0, degrees_of_freedom = 0.0;
  std::vector<Regression> single;
  for (const auto& line : lines) {
    const Eigen::Vector3d along = line.front().direction;
    const auto fit = regression_over(
        line, 3, mass_per_gain_kg, [&](const GuidedWay& way) -> Eigen::Matrix<double, 1, 3> {
          return {-way.direction.dot(along), way.speed_m_per_s, way.path_ratio};
        });
    if (!fit) refuse_ways();
    squares += fit->squares;
    degrees_of_freedom += fit->degrees_of_freedom;
    opposing.damping_by_line.push_back(measured_at(*fit, 1));
    single.push_back(*fit);
  }
  const double more = common->degrees_of_freedom - degrees_of_freedom;
  if (more <= 0.0 || !(squares > 0.0)) return opposing;
  const double ratio = (common->squares - squares) / more / (squares / degrees_of_freedom);
  constexpr double kSure = 0.999;
  opposing.is_alike = ratio < fisher_f_quantile(kSure, more, degrees_of_freedom);
  if (!opposing.is_alike) {
    opposing.damping = measured_at(single.front(), 1);
    opposing.friction = measured_at(single.front(), 2);
    opposing.residual = single.front().residual();
  }
  return opposing;
}

}  // namespace

GuidedWay guided_way(const Eigen::Vector3d& direction, const std::vector<double>& position_m,
                     const std::vector<double>& commanded_n, double period_s, double load_n,
                     int pose) {
  constexpr std::size_t kFewest = 60, kReach = 8;
  // A slower motion backwards may be noise of the positions.
  constexpr double kMoving_m_per_s = 0.0025;
  const std::size_t n = position_m.size();
  if (n < kFewest || commanded_n.size() != n) {
    throw core::Error("guided way: expected at least 60 ticks, found " + std::to_string(n));
  }
  const auto speed_at = [&](std::size_t tick) {
    return (position_m[tick + kReach] - position_m[tick - kReach]) / (2.0 * kReach * period_s);
  };
  const std::size_t first = kReach, last = n - 1 - kReach;
  double way_m = 0.0, path_m = 0.0, work_j = 0.0, squares = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const double speed_m_per_s = speed_at(i);
    way_m += speed_m_per_s * period_s;
    path_m += (speed_m_per_s < -kMoving_m_per_s ? -speed_m_per_s : speed_m_per_s) * period_s;
    // A mean of speeds would miss how fast the device starts and stops, where the force is
    // largest.
    work_j += commanded_n[i] * 0.5 * (position_m[i + 1] - position_m[i - 1]);
    squares += speed_m_per_s * speed_m_per_s * period_s;
  }
  if (!(way_m > 0.0)) {
    throw core::Error(
        "guided way: expected the device to follow, found that it stood still or "
        "went the other way; it may be blocked, or its friction is larger than the "
        "force that it may give");
  }
  const double begin_m_per_s = speed_at(first), end_m_per_s = speed_at(last);
  return {.direction = direction,
          .speed_m_per_s = squares / way_m,
          .acceleration_m_per_s2 =
              (end_m_per_s * end_m_per_s - begin_m_per_s * begin_m_per_s) / (2.0 * way_m),
          .commanded_n = work_j / way_m,
          .load_n = load_n,
          .pose = pose,
          .path_ratio = path_m / way_m};
}

ForceFit fit_force(const std::vector<GuidedWay>& ways, const Eigen::Vector3d& up,
                   double mass_per_gain_kg, double load_uncertainty_ratio) {
  const std::vector<GuidedWay> of_loads = ways_of_loads(ways, up);
  const Eigen::Index num_coefficients = num_load_coefficients(of_loads);
  const auto loaded = regression_over(
      of_loads, num_coefficients, mass_per_gain_kg,
      [&](const GuidedWay& way) { return load_row(way, up, num_coefficients); });
  if (!loaded) refuse_ways();
  if (!(loaded->coefficients[kLoad] > 0.0)) {
    throw core::Error(
        "force: expected a device that pulls more where more hangs from it, found the "
        "opposite; "
        "check which way is up and which weight hung when");
  }
  const Opposing opposing = opposing_of(ways, mass_per_gain_kg);

  ForceFit fit;
  fit.num_ways = static_cast<int>(ways.size());
  fit.ways = ways;
  fit.up = up;
  fit.mass_per_gain_kg = mass_per_gain_kg;
  fit.residual_n = opposing.residual;
  const double gain = 1.0 / loaded->coefficients[kLoad];
  const double gain_error = gain * gain * loaded->error(kLoad);
  const double gain_error_ratio = gain_error / gain;
  fit.gain = measured(gain, std::hypot(gain_error, load_uncertainty_ratio * gain),
                      loaded->degrees_of_freedom);
  // The uncertainty of the gain and of the loads enters everything in newtons.
  const auto in_newtons = [&](const Measured& commanded) {
    const double value = gain * commanded.value;
    const double open = student_t975(loaded->degrees_of_freedom) * value *
                        std::hypot(gain_error_ratio, load_uncertainty_ratio);
    return Measured{
        .value = value,
        .ci95_low = value - std::hypot(gain * (commanded.value - commanded.ci95_low), open),
        .ci95_high = value + std::hypot(gain * (commanded.ci95_high - commanded.value), open)};
  };
  fit.damping_n_s_per_m = in_newtons(opposing.damping);
  fit.friction_n = in_newtons(opposing.friction);
  fit.hysteresis_n = opposing.friction;
  // With several speeds, damping and friction replace it.
  if (num_coefficients == kOpposing + 1) {
    fit.lifting_opposed_n = loaded->coefficients[kOpposing];
  }
  for (const Measured& damping : opposing.damping_by_line) {
    fit.damping_by_axis_n_s_per_m.push_back(in_newtons(damping));
  }
  fit.damps_alike = opposing.is_alike;

  // The loads determine best what acts up or down. Its uncertainty and that of the gain are
  // combined by the delta method.
  const double upwards = loaded->coefficients[kUpwards];
  const Eigen::Vector3d offset = opposing.offset + (upwards - opposing.offset.dot(up)) * up;
  fit.offset_n = gain * offset;
  const Eigen::Vector2d gradient(-gain, gain * gain * upwards);
  const Eigen::Matrix2d covariance =
      loaded->covariance.topLeftCorner<2, 2>();  // The order is upwards, load.
  const double weight_n = -gain * upwards;
  fit.weight_n = measured(weight_n,
                          std::sqrt(gradient.dot(covariance * gradient) +
                                    std::pow(load_uncertainty_ratio * weight_n, 2)),
                          loaded->degrees_of_freedom);
  fit.pose_spread_ratio = gain_spread_ratio(of_loads, up, mass_per_gain_kg, *loaded);
  return fit;
}

double fitted_n(const ForceFit& fit, const GuidedWay& way) {
  const double balanced_n =
      (load_along_n(fit, way) - fit.offset_n.dot(way.direction)) / fit.gain.value;
  // Loads have a fit of their own, because axes may be damped differently.
  if (way.load_n != 0.0 && fit.lifting_opposed_n) {
    return balanced_n + way.path_ratio * *fit.lifting_opposed_n;
  }
  return balanced_n + (fit.damping_n_s_per_m.value * way.speed_m_per_s +
                       fit.friction_n.value * way.path_ratio) /
                          fit.gain.value;
}

double commanded_without_mass_n(const ForceFit& fit, const GuidedWay& way) {
  return way.commanded_n - fit.mass_per_gain_kg * way.acceleration_m_per_s2;
}

double load_along_n(const ForceFit& fit, const GuidedWay& way) {
  return load_along_n(way, fit.up);
}

}  // namespace jnd::analysis
