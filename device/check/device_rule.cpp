#include "device/check/device_rule.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace jnd::device {

core::PointVectors push_of(int point, const Eigen::Vector3d& force_n) {
  core::PointVectors all = core::zero_vectors();
  all[static_cast<std::size_t>(point)] = force_n;
  return all;
}

int pushed_point(const DeviceCapabilities& can) {
  int point = 0;
  while (point + 1 < core::kNumContactPoints && !can.has_point(point)) ++point;
  return point;
}

bool stands_still(std::span<const core::HapticState> states, std::size_t point, int axis) {
  if (states.empty()) return true;
  constexpr double kStill_m = 0.002;
  double low_m = states.back().tip_position_m[point][axis], high_m = low_m;
  for (const core::HapticState& state : states.subspan(states.size() / 2)) {
    low_m = std::min(low_m, state.tip_position_m[point][axis]);
    high_m = std::max(high_m, state.tip_position_m[point][axis]);
  }
  return high_m - low_m < kStill_m;
}

std::string unlikely_numbers(const DeviceCapabilities& can) {
  struct Number {
    const char* what;
    double value, least, most;
    const char* unit;
  };
  const std::array numbers = {
      Number{"half width in x", can.workspace.half_width_x_m, 0.005, 5.0, "m"},
      Number{"half width in y", can.workspace.half_width_y_m, 0.005, 5.0, "m"},
      Number{"half width in z", can.workspace.half_width_z_m, 0.005, 5.0, "m"},
      Number{"largest speed", can.max_speed_m_per_s, 0.05, 50.0, "m/s"},
      Number{"change of the force", can.max_slew_n_per_s, 10.0, 1e7, "N/s"},
      Number{"most force at a point", can.max_force_per_point_n, 0.1, 500.0, "N"},
      Number{"own mass", can.own_mass_kg, 0.0, 100.0, "kg"},
      Number{"own damping", can.own_damping_n_s_per_m, 0.0, 1000.0, "N s/m"},
      Number{"delay", can.closed_loop_delay_s, 0.0, 0.5, "s"}};
  std::string words;
  for (const Number& number : numbers) {
    if (!std::isfinite(number.value)) continue;
    if (number.value >= number.least && number.value <= number.most) continue;
    words += fmt::format("{}{} {:g} {}", words.empty() ? "" : ", ", number.what, number.value,
                         number.unit);
  }
  return words;
}

std::string beyond_what_is_told(const DeviceCapabilities& can,
                                std::span<const core::HapticState> states) {
  if (!can.simulated) return "";
  Eigen::Vector3d furthest_m = Eigen::Vector3d::Zero();
  double fastest_m_per_s = 0.0;
  for (const core::HapticState& state : states) {
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      if (!can.has_point(i)) continue;
      const auto point = static_cast<std::size_t>(i);
      furthest_m = furthest_m.cwiseMax(state.tip_position_m[point].cwiseAbs());
      fastest_m_per_s = std::max(fastest_m_per_s, state.tip_velocity_m_per_s[point].norm());
    }
  }
  const std::array told_m = {can.workspace.half_width_x_m, can.workspace.half_width_y_m,
                             can.workspace.half_width_z_m};
  std::string words;
  const auto add = [&words](const std::string& one) {
    words += (words.empty() ? "" : ", ") + one;
  };
  for (std::size_t axis = 0; axis < told_m.size(); ++axis) {
    const double at_m = furthest_m[static_cast<Eigen::Index>(axis)];
    if (at_m <= told_m[axis]) continue;
    add(fmt::format("it was {:.0f} mm from the origin along {}, and tells {:.0f} mm",
                    1e3 * at_m, "xyz"[axis], 1e3 * told_m[axis]));
  }
  if (fastest_m_per_s > can.max_speed_m_per_s) {
    add(fmt::format("it moved at {:.2f} m/s, and tells {:.2f} m/s at most", fastest_m_per_s,
                    can.max_speed_m_per_s));
  }
  return words;
}

std::string_view name(RuleOutcome::Verdict verdict) noexcept {
  switch (verdict) {
    case RuleOutcome::Verdict::kPassed:
      return "pass";
    case RuleOutcome::Verdict::kFailed:
      return "fail";
    case RuleOutcome::Verdict::kSkipped:
      break;
  }
  return "skip";
}

void RuleJudge::judge(const DeviceRule& rule, bool is_kept, std::string found) {
  all_kept_ &= is_kept;
  tell_({.rule = rule,
         .verdict = is_kept ? RuleOutcome::Verdict::kPassed : RuleOutcome::Verdict::kFailed,
         .found = std::move(found)});
}

void RuleJudge::skip(const DeviceRule& rule, std::string why) {
  tell_({.rule = rule, .verdict = RuleOutcome::Verdict::kSkipped, .found = std::move(why)});
}

}  // namespace jnd::device
