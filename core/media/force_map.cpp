#include "core/media/force_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "core/media/water_drag.h"
#include "core/require.h"

namespace jnd::core {
namespace {

constexpr double kRightAngleRad = std::numbers::pi / 2.0;
// This tolerance lets an author round pi/2 to 1.571 or 1.57.
constexpr double kAngleToleranceRad = 1e-3;

/// Returns "line 7: drag_coefficient", or the field alone if the row has no line.
std::string field_of(const ForceMap::Row& row, const char* field) {
  return (row.line > 0 ? "line " + std::to_string(row.line) + ": " : std::string()) + field;
}

void check(const ForceMap::Row& row) {
  require(row.angle_of_attack_rad >= 0.0 &&
              row.angle_of_attack_rad <= kRightAngleRad + kAngleToleranceRad,
          field_of(row, "angle_of_attack_rad"), "a number >= 0 and <= pi/2",
          row.angle_of_attack_rad);
  require_not_negative(row.speed_m_per_s, field_of(row, "speed_m_per_s"));
  require(row.drag_coefficient >= 0.0 && row.drag_coefficient <= 100.0,
          field_of(row, "drag_coefficient"), "a number >= 0 and <= 100", row.drag_coefficient);
  require(std::abs(row.lift_coefficient) <= 100.0, field_of(row, "lift_coefficient"),
          "a number >= -100 and <= 100", row.lift_coefficient);
}

void check_grid(const std::vector<ForceMap::Row>& rows, const std::vector<double>& angles,
                const std::vector<double>& speeds) {
  require(angles.size() >= 2, "angle_of_attack_rad", "at least two different angles",
          static_cast<double>(angles.size()));
  for (std::size_t i = 1; i < angles.size(); ++i) {
    // Angles that are closer are one angle that was rounded twice, and would give huge slopes.
    require(angles[i] - angles[i - 1] >= 1e-6, "angle_of_attack_rad",
            "angles that are 1e-6 rad apart or more", angles[i]);
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ForceMap::Row& row = rows[i];
    // The rows are sorted by speed and then angle, so the first row that is not the grid's next
    // one is wrong.
    const std::size_t speed = i / angles.size();
    const bool is_next = speed < speeds.size() && row.speed_m_per_s == speeds[speed] &&
                         row.angle_of_attack_rad == angles[i % angles.size()];
    require(is_next, field_of(row, "angle_of_attack_rad"),
            "every angle with every speed, each once, but a row before this one is missing or "
            "stands twice",
            row.angle_of_attack_rad);
  }
  require(rows.size() == angles.size() * speeds.size(), "angle_of_attack_rad",
          "every angle with every speed, each once; number of rows",
          static_cast<double>(rows.size()));
}

std::vector<double> sorted_once(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

/// Returns the harmonic mean of the slopes on both sides, weighted by their widths, and 0 at a
/// turning point.
double inner_slope(double left_width, double left, double right_width, double right) noexcept {
  if (!(left * right > 0.0)) return 0.0;
  const double left_weight = 2.0 * right_width + left_width;
  const double right_weight = right_width + 2.0 * left_width;
  return (left_weight + right_weight) / (left_weight / left + right_weight / right);
}

/// Returns the slopes at the nodes of one curve. At a flat end the curve is even about its end,
/// so its slope is 0 there.
std::vector<double> slopes(const std::vector<double>& x, const std::vector<double>& y,
                           bool flat_first, bool flat_last) {
  const std::size_t last = x.size() - 1;
  const auto secant = [&](std::size_t i) { return (y[i + 1] - y[i]) / (x[i + 1] - x[i]); };
  std::vector<double> slope(x.size());
  slope[0] = flat_first ? 0.0 : secant(0);
  slope[last] = flat_last ? 0.0 : secant(last - 1);
  for (std::size_t i = 1; i < last; ++i) {
    slope[i] = inner_slope(x[i] - x[i - 1], secant(i - 1), x[i + 1] - x[i], secant(i));
  }
  return slope;
}

double hermite(double part, double width, double left, double left_slope, double right,
               double right_slope) noexcept {
  const double rest = 1.0 - part;
  return rest * rest * ((1.0 + 2.0 * part) * left + part * width * left_slope) +
         part * part * ((1.0 + 2.0 * rest) * right - rest * width * right_slope);
}

/// Returns the index of the interval that holds `value`, and in `part` the position within it,
/// 0 to 1. Both are 0 if there is a single value.
std::size_t interval_of(const std::vector<double>& values, double value,
                        double& part) noexcept {
  part = 0.0;
  if (values.size() == 1 || !(value > values.front())) return 0;
  if (value >= values.back()) {
    part = 1.0;
    return values.size() - 2;
  }
  const auto above = std::upper_bound(values.begin(), values.end(), value);
  const auto index = static_cast<std::size_t>(above - values.begin()) - 1;
  part = (value - values[index]) / (values[index + 1] - values[index]);
  return index;
}

}  // namespace

ForceMap::ForceMap(std::vector<Row> rows) {
  for (const Row& row : rows) {
    check(row);
    angle_of_attack_rad_.push_back(row.angle_of_attack_rad);
    speed_m_per_s_.push_back(row.speed_m_per_s);
    has_lift_ = has_lift_ || row.lift_coefficient != 0.0;
  }
  angle_of_attack_rad_ = sorted_once(std::move(angle_of_attack_rad_));
  speed_m_per_s_ = sorted_once(std::move(speed_m_per_s_));
  const std::vector<double>& angles = angle_of_attack_rad_;
  std::stable_sort(rows.begin(), rows.end(), [](const Row& left, const Row& right) {
    if (left.speed_m_per_s != right.speed_m_per_s) {
      return left.speed_m_per_s < right.speed_m_per_s;
    }
    return left.angle_of_attack_rad < right.angle_of_attack_rad;
  });
  check_grid(rows, angles, speed_m_per_s_);
  const bool from_zero = angles.front() <= kAngleToleranceRad;
  const bool to_right_angle = angles.back() >= kRightAngleRad - kAngleToleranceRad;
  if (has_lift_) {
    require(from_zero, "angle_of_attack_rad", "0 as the first angle of a map with lift",
            angles.front());
    require(to_right_angle, "angle_of_attack_rad", "pi/2 as the last angle of a map with lift",
            angles.back());
  }
  for (std::size_t speed = 0; speed < speed_m_per_s_.size(); ++speed) {
    const Row* const first = &rows[speed * angles.size()];
    std::vector<double> drag;
    std::vector<double> lift;
    for (std::size_t i = 0; i < angles.size(); ++i) {
      const bool is_end = i == 0 || i + 1 == angles.size();
      require(!is_end || first[i].lift_coefficient == 0.0,
              field_of(first[i], "lift_coefficient"), "0 at the angles 0 and pi/2",
              first[i].lift_coefficient);
      drag.push_back(first[i].drag_coefficient);
      lift.push_back(first[i].lift_coefficient);
    }
    const std::vector<double> drag_slope = slopes(angles, drag, from_zero, to_right_angle);
    const std::vector<double> lift_slope = slopes(angles, lift, false, false);
    for (std::size_t i = 0; i < angles.size(); ++i) {
      nodes_.push_back({{drag[i], lift[i]}, {drag_slope[i], lift_slope[i]}});
    }
  }
}

ForceMap::Coefficients ForceMap::along_angle(std::size_t speed, std::size_t angle,
                                             double part) const noexcept {
  const Node& left = nodes_[speed * angle_of_attack_rad_.size() + angle];
  const Node& right = (&left)[1];
  const double width = angle_of_attack_rad_[angle + 1] - angle_of_attack_rad_[angle];
  return {hermite(part, width, left.value.drag, left.slope_per_rad.drag, right.value.drag,
                  right.slope_per_rad.drag),
          hermite(part, width, left.value.lift, left.slope_per_rad.lift, right.value.lift,
                  right.slope_per_rad.lift)};
}

ForceMap::Coefficients ForceMap::at(double angle_of_attack_rad,
                                    double speed_m_per_s) const noexcept {
  if (std::isnan(angle_of_attack_rad) || std::isnan(speed_m_per_s)) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    return {kNan, kNan};
  }
  double angle_part = 0.0;
  double speed_part = 0.0;
  const std::size_t angle = interval_of(angle_of_attack_rad_, angle_of_attack_rad, angle_part);
  const std::size_t speed = interval_of(speed_m_per_s_, speed_m_per_s, speed_part);
  const Coefficients slow = along_angle(speed, angle, angle_part);
  if (speed_part == 0.0) return slow;
  const Coefficients fast = along_angle(speed + 1, angle, angle_part);
  return {slow.drag + speed_part * (fast.drag - slow.drag),
          slow.lift + speed_part * (fast.lift - slow.lift)};
}

double mapped_drag_coefficient(const HandMotion& motion, const ForceMap* map) noexcept {
  if (map == nullptr) return WaterDrag::drag_coefficient(motion.sin_angle_of_attack);
  return map->at(std::asin(motion.sin_angle_of_attack), motion.speed_m_per_s).drag;
}

}  // namespace jnd::core
