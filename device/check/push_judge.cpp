#include "device/check/push_judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace jnd::device {
namespace {

constexpr double kResolution_m = 0.0005;
constexpr double kLatest_s = 0.020;

double time_since(const core::HapticState& state, const core::HapticState& begin) {
  return 1e-9 * static_cast<double>(state.device_time_ns - begin.device_time_ns);
}

core::PointVectors mean_acted(std::span<const core::HapticState> states) {
  core::PointVectors mean_n = core::zero_vectors();
  for (const core::HapticState& state : states) {
    for (std::size_t i = 0; i < state.acted_n.size(); ++i) {
      mean_n[i] += state.acted_n[i] / static_cast<double>(states.size());
    }
  }
  return mean_n;
}

}  // namespace

void PushJudge::observe(const Push& push) {
  if (push.before.size() < 4 || push.during.size() < 4) return;
  if (can_.tells_acting_force) observe_acted(push);
  int axis = 0;
  push.force_n.cwiseAbs().maxCoeff(&axis);
  if (stands_still(push.before, static_cast<std::size_t>(push.point), axis)) {
    observe_motion(push, axis);
  }
}

void PushJudge::observe_acted(const Push& push) {
  const auto told = std::ranges::find_if(push.during, [&](const core::HapticState& state) {
    return !state.acted_n[static_cast<std::size_t>(push.point)].isZero(0.0);
  });
  if (told != push.during.end()) {
    told_after_s_ = std::min(told_after_s_, time_since(*told, push.during.front()));
  }
  // The force has come by then, unless the device changes it slowly or late.
  const auto settled = push.during.subspan(push.during.size() - push.during.size() / 3);
  const double had_s = time_since(settled.front(), push.during.front());
  const double asked_n = push.force_n.norm();
  if (had_s < can_.closed_loop_delay_s + asked_n / can_.max_slew_n_per_s) return;
  if (asked_n > std::min(can_.max_force_per_point_n, can_.max_total_force_n)) return;
  const core::PointVectors mean_n = mean_acted(settled);
  const bool any = std::ranges::any_of(
      mean_n, [](const Eigen::Vector3d& force_n) { return !force_n.isZero(0.0); });
  if (!any) return;  // Another rule says that no force acts.
  ++num_told_;
  const double tolerance_n = 0.25 * asked_n + 0.05;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    const Eigen::Vector3d& told_n = mean_n[static_cast<std::size_t>(i)];
    const Eigen::Vector3d expected_n = i == push.point ? push.force_n : core::zero_vectors()[0];
    const double along_n = told_n.dot(push.force_n) / asked_n;
    // A real device may measure the force, which is smaller if nothing resists.
    const bool is_right = can_.simulated || i != push.point
                              ? (told_n - expected_n).norm() <= tolerance_n
                              : along_n >= -tolerance_n && along_n <= asked_n + tolerance_n;
    if (is_right || !untold_.empty()) continue;
    untold_ =
        fmt::format("asked for {:.2g} N at point {}, it tells {:.2g} N along it at point {}",
                    asked_n, push.point + 1, along_n, i + 1);
  }
}

void PushJudge::observe_motion(const Push& push, int axis) {
  const auto point = static_cast<std::size_t>(push.point);
  const auto rest = push.before.subspan(push.before.size() / 2);
  const double rested_s = time_since(rest.back(), rest.front());
  const double direction = push.force_n[axis] < 0.0 ? -1.0 : 1.0;
  const auto moved_m = [&](std::size_t of, const core::HapticState& state) {
    const double drift_m_per_s =
        rested_s > 0.0
            ? (rest.back().tip_position_m[of] - rest.front().tip_position_m[of])[axis] /
                  rested_s
            : 0.0;
    return direction * ((state.tip_position_m[of] - rest.back().tip_position_m[of])[axis] -
                        drift_m_per_s * time_since(state, rest.back()));
  };
  ++num_moved_;
  const core::HapticState& last = push.during.back();
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (i == push.point || !can_.has_point(i) || !elsewhere_.empty()) continue;
    const double other_m = std::fabs(moved_m(static_cast<std::size_t>(i), last));
    if (other_m <= 2.0 * std::fabs(moved_m(point, last)) + 2.0 * kResolution_m) continue;
    elsewhere_ = fmt::format("pushed at point {} by {:.1f} mm, point {} moved {:.1f} mm",
                             push.point + 1, 1e3 * moved_m(point, last), i + 1, 1e3 * other_m);
  }
  constexpr double kSeen_m = 0.00005, kBegan_s = 0.005, kAllowance = 1.7;
  const auto moving = std::ranges::find_if(push.during, [&](const core::HapticState& state) {
    return moved_m(point, state) > kSeen_m;
  });
  const double mass_kg = std::max(1.0, can_.own_mass_kg);
  const double seen_after_s = 2.0 * std::sqrt(2.0 * kSeen_m * mass_kg / push.force_n.norm());
  if (moving != push.during.end()) {
    moved_after_s_ =
        std::min(moved_after_s_, time_since(*moving, push.during.front()) - seen_after_s);
  }
  if (can_.own_mass_kg <= 0.0 || !too_far_.empty()) return;
  for (const core::HapticState& state : push.during) {
    const double since_s = time_since(state, push.during.front()) + kBegan_s;
    const double free_m = 0.5 * push.force_n.norm() / can_.own_mass_kg * since_s * since_s;
    if (moved_m(point, state) <= kAllowance * free_m + kResolution_m) continue;
    too_far_ = fmt::format(
        "{:.2g} N moved it by {:.1f} mm in {:.0f} ms, and {:.3g} kg alone by {:.1f} mm",
        push.force_n.norm(), 1e3 * moved_m(point, state), 1e3 * since_s, can_.own_mass_kg,
        1e3 * free_m);
    return;
  }
}

void PushJudge::judge(RuleJudge& judge) const {
  if (num_told_ == 0) {
    judge.skip(kActed, can_.tells_acting_force ? "no force acted, or not all of it in time"
                                               : "the device does not tell which force acted");
  } else {
    judge.judge(kActed, untold_.empty(), untold_);
  }
  if (can_.num_contact_points() < 2) {
    judge.judge(kPoints, true, "the device has one point");
  } else if (num_moved_ == 0) {
    judge.skip(kPoints, kHidesPush);
  } else {
    judge.judge(kPoints, elsewhere_.empty(), elsewhere_);
  }
  if (can_.own_mass_kg <= 0.0) {
    judge.skip(kForceSize, "the device does not tell its own mass");
  } else if (num_moved_ == 0) {
    judge.skip(kForceSize, kHidesPush);
  } else {
    judge.judge(kForceSize, too_far_.empty(), too_far_);
  }
}

void PushJudge::judge_delay(RuleJudge& judge) const {
  if (!std::isfinite(told_after_s_)) {
    return judge.skip(kDelay, "no force was told of");
  }
  const double allowed_s = can_.closed_loop_delay_s + kLatest_s;
  const bool is_told_late = told_after_s_ > allowed_s;
  const bool is_late = std::isfinite(moved_after_s_) && moved_after_s_ > allowed_s;
  judge.judge(
      kDelay, !is_told_late && !is_late,
      is_told_late
          ? fmt::format("it tells of a force {:.0f} ms after it was asked for, {:.0f} ms are "
                        "allowed",
                        1e3 * told_after_s_, 1e3 * allowed_s)
      : is_late
          ? fmt::format("the hand moved {:.0f} ms later than expected, {:.0f} ms are allowed",
                        1e3 * moved_after_s_, 1e3 * allowed_s)
          : "");
}

}  // namespace jnd::device
