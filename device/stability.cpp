#include "device/stability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/require.h"
#include "device/haptic_loop.h"

namespace jnd::device {
namespace {

double norm_of(const core::PlainVector& vector) noexcept {
  return std::sqrt(vector[0] * vector[0] + vector[1] * vector[1] + vector[2] * vector[2]);
}

/// Judges the last part of a run by the part before.
class Judge {
 public:
  void watch(const core::Sample& sample) noexcept {
    for (const core::PlainVector& velocity : sample.tip_velocity_m_per_s) {
      highest_before_m_per_s_ = std::max(highest_before_m_per_s_, norm_of(velocity));
    }
  }

  void judge(const core::Telemetry& telemetry) noexcept {
    const core::Sample& sample = telemetry.sample;
    for (std::size_t point = 0; point < sample.tip_force_n.size(); ++point) {
      highest_m_per_s_ =
          std::max(highest_m_per_s_, norm_of(sample.tip_velocity_m_per_s[point]));
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double force_n = sample.tip_force_n[point][axis];
        least_n_[point][axis] = std::min(least_n_[point][axis], force_n);
        most_n_[point][axis] = std::max(most_n_[point][axis], force_n);
      }
    }
    ++num_judged_;
    if (telemetry.limited) ++num_limited_;
  }

  [[nodiscard]] bool is_at_rest(const SettlingCriterion& criterion) const noexcept {
    double swing_n = 0.0;
    for (std::size_t point = 0; point < least_n_.size(); ++point) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        swing_n = std::max(swing_n, most_n_[point][axis] - least_n_[point][axis]);
      }
    }
    return highest_m_per_s_ <= criterion.rest_speed_m_per_s &&
           highest_m_per_s_ <= criterion.rest_ratio * highest_before_m_per_s_ &&
           swing_n <= criterion.force_swing_n &&
           static_cast<double>(num_limited_) <=
               criterion.limited_ratio * static_cast<double>(num_judged_);
  }

 private:
  static constexpr double kMost = std::numeric_limits<double>::infinity();
  using Bounds = std::array<core::PlainVector, core::kNumContactPoints>;
  static constexpr Bounds all(double value) noexcept {
    Bounds bounds{};
    for (core::PlainVector& point : bounds) point.fill(value);
    return bounds;
  }

  double highest_before_m_per_s_ = 0.0, highest_m_per_s_ = 0.0;
  Bounds least_n_ = all(kMost), most_n_ = all(-kMost);
  std::int64_t num_judged_ = 0, num_limited_ = 0;
};

}  // namespace

bool settles(HapticDevice& device, const core::HapticCommand& command, double rate_hz,
             const SettlingCriterion& criterion) {
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  // Guards would end the run before its limit is found.
  HapticLoop loop({.starts_armed = true,
                   .rate_hz = rate_hz,
                   .watches_port = false,
                   .flight_recorder_s = 0.001},
                  device, {commands, telemetry, stop});
  core::HapticCommand at_once = command;
  at_once.sequence = 1;
  at_once.ramp_s = 0.0;
  commands.publish(at_once);

  Judge judge;
  const auto num_ticks = std::llround(criterion.duration_s * rate_hz);
  const auto first_judged = std::llround((criterion.duration_s - criterion.judged_s) * rate_hz);
  device.open();
  bool has_fault = false;
  for (std::int64_t tick = 0; tick < num_ticks && !has_fault; ++tick) {
    loop.tick();
    telemetry.fetch();
    has_fault = telemetry.value().fault != core::Fault::kNone;
    if (tick < first_judged) {
      judge.watch(telemetry.value().sample);
    } else {
      judge.judge(telemetry.value());
    }
  }
  device.close();
  return !has_fault && judge.is_at_rest(criterion);
}

StabilityLimit largest_stable(const StabilityLadder& ladder,
                              const std::function<bool(double)>& is_stable) {
  core::require_positive(ladder.first, "first");
  core::require(ladder.last >= ladder.first && std::isfinite(ladder.last), "last",
                "a finite number >= first", ladder.last);
  core::require(ladder.step_ratio > 1.0, "step_ratio", "a number > 1", ladder.step_ratio);
  core::require(ladder.resolution_ratio > 1.0, "resolution_ratio", "a number > 1",
                ladder.resolution_ratio);
  double stable = 0.0;
  double unstable = ladder.first;
  while (is_stable(unstable)) {
    stable = unstable;
    if (stable >= ladder.last) return {.value = stable, .is_beyond_ladder = true};
    unstable = std::min(ladder.last, stable * ladder.step_ratio);
  }
  while (stable > 0.0 && unstable > stable * ladder.resolution_ratio) {
    const double middle = std::sqrt(stable * unstable);
    (is_stable(middle) ? stable : unstable) = middle;
  }
  return {.value = stable};
}

}  // namespace jnd::device
