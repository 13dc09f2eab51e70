#include "analysis/mixed/people_lines.h"

#include <Eigen/Core>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "analysis/fits/ceres_descent.h"
#include "analysis/fits/profile_crossing.h"
#include "analysis/statistics/distributions.h"
#include "core/require.h"

namespace jnd::analysis {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr std::size_t kFewestPeople = 3;
/// A smaller spread between people, in units of the residual, counts as 0, because a search
/// comes to rest beside that bound.
constexpr double kNoLineSpread = 1e-3;
/// The rounding error that is left if there is no residual: its square if y is of the order of
/// 1, as logarithms are, and its share of all squares about the pooled line.
constexpr double kNoSquare = 1e-18, kNoShare = 1e-13;

/// The sums over one person's rows z = (1, u) that the likelihood needs.
struct PersonSums {
  Matrix2d zz = Matrix2d::Zero();
  Vector2d zy = Vector2d::Zero();
  double yy = 0.0;
};

/// The rows over u = (x - centre) / scale, as residuals from the line through all of them.
/// Parameters are then of the order of 1, and few digits cancel.
struct PeopleSums {
  std::vector<PersonSums> people;
  double centre = 0.0, scale = 1.0;
  Line pooled;  ///< The line over u.
  double num_rows = 0.0;
};

bool has_slope(const PersonSums& person) {
  return person.zz.determinant() > 1e-12 * person.zz(0, 0) * person.zz(0, 0);
}

/// The least-squares line of one person's rows over u.
Vector2d own_line(const PersonSums& person) { return person.zz.inverse() * person.zy; }

PeopleSums sums_over(const std::vector<PersonPoint>& rows, std::size_t num_people,
                     double centre, double scale) {
  PeopleSums sums{.people = std::vector<PersonSums>(num_people),
                  .centre = centre,
                  .scale = scale,
                  .pooled = {},
                  .num_rows = static_cast<double>(rows.size())};
  Matrix2d zz = Matrix2d::Zero();
  Vector2d zy = Vector2d::Zero();
  for (const PersonPoint& row : rows) {
    const Vector2d z(1.0, (row.x - centre) / scale);
    zz += z * z.transpose();
    zy += row.y * z;
  }
  const Vector2d line = zz.inverse() * zy;
  sums.pooled = {line[0], line[1]};
  for (const PersonPoint& row : rows) {
    PersonSums& person = sums.people[row.person];
    const Vector2d z(1.0, (row.x - centre) / scale);
    const double y = row.y - line.dot(z);
    person.zz += z * z.transpose();
    person.zy += y * z;
    person.yy += y * y;
  }
  return sums;
}

enum class Likelihood { kRestricted, kFull };

/// A linear combination of the fixed effects that is held, and its value above that of the
/// pooled line.
struct Held {
  Vector2d weights;
  double value = 0.0;
};

/// Minus twice the log-likelihood at a relative factor L, where the covariance of (u0, u1) is
/// the residual variance times L L'. Fixed effects and residual variance are at their optimum.
class LinesDeviance {
 public:
  LinesDeviance(const PeopleSums& sums, Likelihood kind, std::optional<Held> held = {})
      : sums_(sums), kind_(kind), held_(std::move(held)), parts_(sums.people.size()) {}

  /// `theta` holds the lower triangle of L, column by column. Returns false outside the range
  /// of numbers.
  bool evaluate(std::span<const double> theta) {
    factor_ << theta[0], 0.0, theta[1], theta[2];
    precision_.setZero();
    score_.setZero();
    double log_determinants = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const PersonSums& person = sums_.people[i];
      const Matrix2d d =
          // This is at least the identity.
          Matrix2d::Identity() + factor_.transpose() * person.zz * factor_;
      log_determinants += std::log(d.determinant());
      const Matrix2d m = factor_ * d.inverse() * factor_.transpose();
      parts_[i].precision = person.zz - person.zz * m * person.zz;
      parts_[i].score = person.zy - person.zz * m * person.zy;
      precision_ += parts_[i].precision;
      score_ += parts_[i].score;
      squares += person.yy - person.zy.dot(m * person.zy);
    }
    solve_fixed();
    squares_ = squares - 2.0 * fixed_.dot(score_) + fixed_.dot(precision_ * fixed_);
    freedom_ = sums_.num_rows - (kind_ == Likelihood::kRestricted ? 2.0 : 0.0);
    value_ = log_determinants +
             freedom_ * (1.0 + std::log(2.0 * std::numbers::pi * squares_ / freedom_));
    if (kind_ == Likelihood::kRestricted) value_ += std::log(precision_.determinant());
    return squares_ > 0.0 && std::isfinite(value_);
  }

  /// The gradient at the last evaluation. With P_i = Z_i' V_i^-1 Z_i and g_i = Z_i' V_i^-1
  /// times the residuals, it is 2 sum (P_i - P_i P^-1 P_i - g_i g_i' / variance) L.
  [[nodiscard]] std::array<double, 3> gradient() const {
    Matrix2d sum = Matrix2d::Zero();
    const Matrix2d inverse = precision_.inverse();
    for (const Part& part : parts_) {
      const Vector2d residual = residual_score(part);
      sum += part.precision - residual * residual.transpose() / variance();
      if (kind_ == Likelihood::kRestricted) sum -= part.precision * inverse * part.precision;
    }
    const Matrix2d full = 2.0 * sum * factor_;
    return {full(0, 0), full(1, 0), full(1, 1)};
  }

  [[nodiscard]] double value() const noexcept { return value_; }
  [[nodiscard]] double variance() const noexcept { return squares_ / freedom_; }
  [[nodiscard]] const Vector2d& fixed() const noexcept { return fixed_; }
  [[nodiscard]] Matrix2d fixed_covariance() const { return variance() * precision_.inverse(); }
  [[nodiscard]] Matrix2d people_covariance() const {
    return variance() * factor_ * factor_.transpose();
  }
  /// The most likely u0 and u1 of one person, given the other parameters.
  [[nodiscard]] Vector2d deviation(std::size_t person) const {
    return factor_ * (factor_.transpose() * residual_score(parts_[person]));
  }

 private:
  struct Part {
    Matrix2d precision;
    Vector2d score;
  };

  [[nodiscard]] Vector2d residual_score(const Part& part) const {
    return part.score - part.precision * fixed_;
  }
  void solve_fixed() {
    const Matrix2d inverse = precision_.inverse();
    fixed_ = inverse * score_;
    if (!held_) return;
    const Vector2d toward = inverse * held_->weights;
    fixed_ -= toward * (held_->weights.dot(fixed_) - held_->value) / held_->weights.dot(toward);
  }

  const PeopleSums& sums_;
  Likelihood kind_;
  std::optional<Held> held_;
  std::vector<Part> parts_;
  Matrix2d factor_ = Matrix2d::Zero(), precision_ = Matrix2d::Zero();
  Vector2d fixed_ = Vector2d::Zero(), score_ = Vector2d::Zero();
  double squares_ = 0.0, freedom_ = 1.0, value_ = 0.0;
};

/// The factor L that people's own lines suggest, after subtracting what their residuals
/// explain.
std::array<double, 3> factor_of_own_lines(const PeopleSums& sums) {
  double within = 0.0, freedom = 0.0, num = 0.0;
  Matrix2d noise = Matrix2d::Zero(), spread = Matrix2d::Zero();
  Vector2d mean = Vector2d::Zero();
  for (const PersonSums& person : sums.people) {
    if (!has_slope(person)) continue;
    const Vector2d line = own_line(person);
    within += person.yy - person.zy.dot(line);
    freedom += person.zz(0, 0) - 2.0;
    noise += person.zz.inverse();
    spread += line * line.transpose();
    mean += line;
    num += 1.0;
  }
  const double variance = within / std::max(1.0, freedom);
  mean /= num;
  const Matrix2d relative = (spread / num - mean * mean.transpose()) / variance - noise / num;
  const double first = std::sqrt(std::max(0.05, relative(0, 0)));
  const double second = std::max(0.05, relative(1, 1));
  const double limit = 0.9 * std::sqrt(second);
  const double below = std::clamp(relative(1, 0) / first, -limit, limit);
  return {first, below, std::sqrt(second - below * below)};
}

/// Minimises the deviance over L from several starts, because the deviance is flat at the
/// bounds of 0. Returns false if no search came to rest.
bool minimise(const PeopleSums& sums, LinesDeviance& deviance) {
  const SmoothCost cost = [&deviance](std::span<const double> theta, double& value,
                                      std::span<double> gradient) {
    if (!deviance.evaluate(theta)) return false;
    value = deviance.value();
    std::ranges::copy(deviance.gradient(), gradient.begin());
    return true;
  };
  const std::array<double, 3> likely = factor_of_own_lines(sums);
  std::vector<double> best;
  double least = 0.0;
  for (const std::array<double, 3>& start :
       {likely, std::array<double, 3>{1.0, 0.0, 1.0},
        std::array<double, 3>{likely[0], -0.5 * likely[1], 0.2}}) {
    std::vector<double> theta = ceres_minimum(cost, {start.begin(), start.end()});
    // The search stops by changes of the value, so a second search continues with fresh
    // curvatures.
    theta = ceres_minimum(cost, theta);
    if (!deviance.evaluate(theta)) continue;
    if (best.empty() || deviance.value() < least) {
      least = deviance.value();
      best = theta;
    }
  }
  return !best.empty() && deviance.evaluate(best);
}

struct Axis {
  double centre = 0.0, scale = 1.0;
};

/// The mean and standard deviation of x. The scale is 0 if all x are equal.
Axis axis_of(const std::vector<PersonPoint>& rows) {
  Axis axis{.centre = 0.0, .scale = 0.0};
  for (const PersonPoint& row : rows) axis.centre += row.x / static_cast<double>(rows.size());
  for (const PersonPoint& row : rows) {
    axis.scale += (row.x - axis.centre) * (row.x - axis.centre);
  }
  axis.scale = std::sqrt(axis.scale / static_cast<double>(rows.size()));
  return axis;
}

/// Converts a line over u into a line over x.
Line over_x(const PeopleSums& sums, const Vector2d& above_pooled) {
  const double slope = (sums.pooled.slope + above_pooled[1]) / sums.scale;
  return {sums.pooled.intercept + above_pooled[0] - slope * sums.centre, slope};
}

std::string why_no_lines(const PeopleSums& sums) {
  const auto num_lines =
      static_cast<std::size_t>(std::ranges::count_if(sums.people, has_slope));
  if (num_lines < kFewestPeople) {
    return "expected at least " + std::to_string(kFewestPeople) +
           " participants with two different intensities each, found " +
           std::to_string(num_lines);
  }
  if (sums.num_rows <= 2.0 * static_cast<double>(sums.people.size())) {
    return "expected more than two rows a participant, found " +
           std::to_string(static_cast<std::size_t>(sums.num_rows)) + " rows of " +
           std::to_string(sums.people.size()) +
           " participants, so that nothing tells how far rows scatter";
  }
  double within = 0.0, all = 0.0;
  for (const PersonSums& person : sums.people) {
    if (!(person.zz(0, 0) > 0.0)) continue;
    all += person.yy;
    const Vector2d line =
        has_slope(person) ? own_line(person) : Vector2d(person.zy[0] / person.zz(0, 0), 0.0);
    within += person.yy - person.zy.dot(line);
  }
  if (!(within > kNoSquare * sums.num_rows) || !(within > kNoShare * all)) {
    return "everybody's rows lie on a law of their own, so that nothing tells how far rows "
           "scatter";
  }
  return "";
}

void require_rows(const std::vector<PersonPoint>& rows, std::size_t num_people) {
  for (const PersonPoint& row : rows) {
    core::require(std::isfinite(row.x), "x", "a finite number", row.x);
    core::require(std::isfinite(row.y), "y", "a finite number", row.y);
    core::require(row.person < num_people, "person", "a number below that of the people",
                  static_cast<double>(row.person));
  }
}

/// Converts the covariance over u into standard deviations and the correlation of intercept and
/// slope over x.
void tell_spread(PeopleLines& lines, const PeopleSums& sums, const Matrix2d& over_u,
                 double residual_sd) {
  Matrix2d covariance = over_u;
  const double bound = kNoLineSpread * residual_sd;
  for (const int place : {0, 1}) {
    if (std::sqrt(over_u(place, place)) >= bound) continue;
    covariance.row(place).setZero();
    covariance.col(place).setZero();
  }
  Matrix2d change;
  change << 1.0, -sums.centre / sums.scale, 0.0, 1.0 / sums.scale;
  covariance = (change * covariance * change.transpose()).eval();
  lines.intercept_sd = std::sqrt(std::max(0.0, covariance(0, 0)));
  lines.slope_sd = std::sqrt(std::max(0.0, covariance(1, 1)));
  if (lines.intercept_sd > 0.0 && lines.slope_sd > 0.0) {
    lines.correlation =
        std::clamp(covariance(0, 1) / (lines.intercept_sd * lines.slope_sd), -1.0, 1.0);
  }
}

}  // namespace

PeopleLines fit_people_lines(const std::vector<PersonPoint>& rows, std::size_t num_people) {
  require_rows(rows, num_people);
  PeopleLines lines;
  lines.status = FitStatus::kDegenerate;
  const Axis axis = axis_of(rows);
  if (!(axis.scale > 0.0)) {
    lines.reason = "expected rows at two different intensities, found fewer";
    return lines;
  }
  const PeopleSums sums = sums_over(rows, num_people, axis.centre, axis.scale);
  lines.reason = why_no_lines(sums);
  if (!lines.reason.empty()) return lines;
  LinesDeviance deviance(sums, Likelihood::kRestricted);
  if (!minimise(sums, deviance)) {
    lines.status = FitStatus::kNotConverged;
    lines.reason = "the search left the range of numbers";
    return lines;
  }
  lines.status = FitStatus::kOk;
  // The density of the restricted likelihood over u differs by a factor of the scale.
  lines.log_likelihood = -0.5 * (deviance.value() + 2.0 * std::log(sums.scale));
  lines.residual_sd = std::sqrt(deviance.variance());
  lines.group = over_x(sums, deviance.fixed());
  Matrix2d change;
  change << 1.0, -sums.centre / sums.scale, 0.0, 1.0 / sums.scale;
  const Matrix2d covariance = change * deviance.fixed_covariance() * change.transpose();
  lines.intercept_standard_error = std::sqrt(covariance(0, 0));
  lines.slope_standard_error = std::sqrt(covariance(1, 1));
  tell_spread(lines, sums, deviance.people_covariance(), lines.residual_sd);
  for (std::size_t i = 0; i < num_people; ++i) {
    lines.people.push_back(over_x(sums, deviance.fixed() + deviance.deviation(i)));
    const PersonSums& person = sums.people[i];
    lines.own.push_back(has_slope(person) ? std::optional(over_x(sums, own_line(person)))
                                          : std::nullopt);
  }
  return lines;
}

Interval people_lines_profile(const std::vector<PersonPoint>& rows, std::size_t num_people,
                              LineParameter of) {
  require_rows(rows, num_people);
  const Axis axis = axis_of(rows);
  const PeopleSums sums = sums_over(rows, num_people, axis.centre, axis.scale);
  LinesDeviance free(sums, Likelihood::kFull);
  if (!minimise(sums, free)) return {};
  // Over u the intercept is at the place where x is 0.
  const bool is_slope = of == LineParameter::kSlope;
  const Vector2d weights =
      is_slope ? Vector2d(0.0, 1.0 / axis.scale) : Vector2d(1.0, -axis.centre / axis.scale);
  const double estimate = weights.dot(free.fixed());
  const double error = std::sqrt(weights.dot(free.fixed_covariance() * weights));
  const double drop = chi_squared_quantile(0.95, 1.0);
  const auto excess = [&](double value) {
    LinesDeviance held(sums, Likelihood::kFull, Held{weights, value});
    if (!minimise(sums, held)) return drop;
    return held.value() - free.value() - drop;
  };
  const double pooled = weights.dot(Vector2d(sums.pooled.intercept, sums.pooled.slope));
  const auto end = [&](double direction) -> std::optional<double> {
    constexpr double kFarthestErrors = 100.0;
    const std::optional<double> at = crossing(
        excess, estimate, 1.5 * error, estimate + direction * kFarthestErrors * error, 1e-9);
    return at ? std::optional(pooled + *at) : std::nullopt;
  };
  return {end(-1.0), end(1.0)};
}

}  // namespace jnd::analysis
