#include "analysis/commissioning/force_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/error.h"

namespace jnd::analysis {
namespace {

/// The coefficients of the regression: all over the gain.
enum Coefficient { kOffsetX, kOffsetY, kOffsetZ, kLoad, kDamping, kFriction, kNumCoefficients };
constexpr double kGravity_m_per_s2 = 9.80665;

using Row = Eigen::Matrix<double, 1, kNumCoefficients>;
using Column = Eigen::Matrix<double, kNumCoefficients, 1>;
using Square = Eigen::Matrix<double, kNumCoefficients, kNumCoefficients>;

Row row_of(const GuidedWay& way, const Eigen::Vector3d& up) {
  Row row;
  // A load has to be carried and to be accelerated.
  const double load_n =
      way.load_n * (up.dot(way.direction) + way.acceleration_m_per_s2 / kGravity_m_per_s2);
  row << -way.direction.x(), -way.direction.y(), -way.direction.z(), load_n, way.speed_m_per_s,
      1.0;
  return row;
}

/// Of the load alone: what is left of the ways of one pose once the whole fit's other parts are
/// taken away.
double gain_spread_ratio(const std::vector<GuidedWay>& ways, const Eigen::Vector3d& up,
                         double mass_per_gain_kg, const Column& fitted) {
  struct Sums {
    double xx = 0.0, xy = 0.0;
  };
  std::map<int, Sums> poses;
  for (const GuidedWay& way : ways) {
    if (way.load_n == 0.0) continue;
    Column others = fitted;
    others[kLoad] = 0.0;
    const double x = row_of(way, up)[kLoad];
    const double y = way.commanded_n - mass_per_gain_kg * way.acceleration_m_per_s2 -
                     row_of(way, up) * others;
    poses[way.pose].xx += x * x;
    poses[way.pose].xy += x * y;
  }
  std::vector<double> ratios;
  for (const auto& [pose, sums] : poses) {
    if (sums.xx > 0.0) ratios.push_back(sums.xy / sums.xx / fitted[kLoad]);
  }
  if (ratios.size() < 2) return 0.0;
  double mean = 0.0, squares = 0.0;
  for (const double ratio : ratios) mean += ratio / static_cast<double>(ratios.size());
  for (const double ratio : ratios) squares += (ratio - mean) * (ratio - mean);
  return std::sqrt(squares / static_cast<double>(ratios.size() - 1));
}

}  // namespace

GuidedWay guided_way(const Eigen::Vector3d& direction, const std::vector<double>& position_m,
                     const std::vector<double>& commanded_n, double period_s, double load_n,
                     int pose) {
  constexpr std::size_t kFewest = 60, kReach = 8;
  const std::size_t n = position_m.size();
  if (n < kFewest || commanded_n.size() != n) {
    throw core::Error("guided way: expected at least 60 ticks, found " + std::to_string(n));
  }
  const auto speed_at = [&](std::size_t tick) {
    return (position_m[tick + kReach] - position_m[tick - kReach]) / (2.0 * kReach * period_s);
  };
  const std::size_t first = kReach, last = n - 1 - kReach;
  double way_m = 0.0, work_j = 0.0, squares = 0.0;
  for (std::size_t i = first; i <= last; ++i) {
    const double speed_m_per_s = speed_at(i);
    way_m += speed_m_per_s * period_s;
    work_j += commanded_n[i] * speed_m_per_s * period_s;
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
          .pose = pose};
}

ForceFit fit_force(const std::vector<GuidedWay>& ways, const Eigen::Vector3d& up,
                   double mass_per_gain_kg, double load_uncertainty_ratio) {
  const auto num_ways = static_cast<Eigen::Index>(ways.size());
  if (num_ways <= kNumCoefficients) {
    throw core::Error("force: expected more than 6 ways, found " + std::to_string(num_ways));
  }
  Eigen::MatrixXd rows(num_ways, static_cast<Eigen::Index>(kNumCoefficients));
  Eigen::VectorXd commanded_n(num_ways);
  for (Eigen::Index i = 0; i < num_ways; ++i) {
    rows.row(i) = row_of(ways[static_cast<std::size_t>(i)], up);
    const GuidedWay& way = ways[static_cast<std::size_t>(i)];
    commanded_n[i] = way.commanded_n - mass_per_gain_kg * way.acceleration_m_per_s2;
  }
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(rows);
  if (solver.rank() < kNumCoefficients) {
    throw core::Error(
        "force: expected ways both to and fro along three axes, at two speeds and with two "
        "loads, "
        "found too few to tell gain, weight, friction and damping apart");
  }
  const Column fitted = solver.solve(commanded_n);
  const double degrees_of_freedom = static_cast<double>(num_ways - kNumCoefficients);
  const double residual_n =
      std::sqrt((commanded_n - rows * fitted).squaredNorm() / degrees_of_freedom);
  const Square covariance = residual_n * residual_n * (rows.transpose() * rows).inverse();
  if (!(fitted[kLoad] > 0.0)) {
    throw core::Error(
        "force: expected a device that pulls more where more hangs from it, found the "
        "opposite; "
        "check which way is up and which weight hung when");
  }

  ForceFit fit;
  fit.num_ways = static_cast<int>(num_ways);
  fit.residual_n = residual_n;
  const double gain = 1.0 / fitted[kLoad];
  // By the delta method; what the loads leave open is common to all that is in newtons.
  const auto in_newtons = [&](const Column& combination, double value) {
    Column gradient = gain * combination;
    gradient[kLoad] -= gain * value;
    const double open = load_uncertainty_ratio * value;
    return measured(value, std::sqrt(gradient.dot(covariance * gradient) + open * open),
                    degrees_of_freedom);
  };
  const auto alone = [](Coefficient coefficient) {
    Column one = Column::Zero();
    one[coefficient] = 1.0;
    return one;
  };
  const double open_gain = load_uncertainty_ratio * gain;
  const double gain_error = gain * gain * std::sqrt(covariance(kLoad, kLoad));
  fit.gain = measured(gain, std::hypot(gain_error, open_gain), degrees_of_freedom);
  fit.offset_n = gain * fitted.head<3>();
  Column down = Column::Zero();
  down.head<3>() = -up;
  fit.weight_n = in_newtons(down, gain * down.dot(fitted));
  fit.damping_n_s_per_m = in_newtons(alone(kDamping), gain * fitted[kDamping]);
  fit.friction_n = in_newtons(alone(kFriction), gain * fitted[kFriction]);
  fit.hysteresis_n = measured(fitted[kFriction], std::sqrt(covariance(kFriction, kFriction)),
                              degrees_of_freedom);
  fit.pose_spread_ratio = gain_spread_ratio(ways, up, mass_per_gain_kg, fitted);
  return fit;
}

}  // namespace jnd::analysis
