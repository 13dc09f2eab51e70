#include "app/commissioning/guided_stimuli.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "device/stability.h"

namespace jnd::app {
namespace {

/// A surface far above whatever the device reaches.
constexpr double kNoSurface_m = 100.0;
constexpr double kForever_s = 1e6;

/// How far the force at any point swings while it is watched.
class Swing {
 public:
  explicit Swing(const device::DeviceCapabilities& can) : can_(can) {
    for (auto& point : least_n_) point.fill(std::numeric_limits<double>::infinity());
    for (auto& point : most_n_) point.fill(-std::numeric_limits<double>::infinity());
  }

  void add(const core::Sample& sample) {
    for (std::size_t point = 0; point < least_n_.size(); ++point) {
      if (!can_.has_point(static_cast<int>(point))) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double force_n = sample.tip_force_n[point][axis];
        least_n_[point][axis] = std::min(least_n_[point][axis], force_n);
        most_n_[point][axis] = std::max(most_n_[point][axis], force_n);
      }
    }
  }

  [[nodiscard]] double largest_n() const {
    double swing_n = 0.0;
    for (std::size_t point = 0; point < least_n_.size(); ++point) {
      if (!can_.has_point(static_cast<int>(point))) continue;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        swing_n = std::max(swing_n, most_n_[point][axis] - least_n_[point][axis]);
      }
    }
    return swing_n;
  }

 private:
  const device::DeviceCapabilities& can_;
  std::array<core::PlainVector, core::kNumContactPoints> least_n_, most_n_;
};

}  // namespace

GuidedStimuli::GuidedStimuli(DeviceOnBench& started, analysis::NoiseFit noise,
                             const analysis::ForceFit& force)
    : started_(started),
      noise_(std::move(noise)),
      friction_n_(std::max(0.0, force.friction_n.value) / force.gain.value),
      carrying_n_(-force.offset_n / force.gain.value),
      home_m_(started.place_m()) {}

void GuidedStimuli::push(const Eigen::Vector3d& force_n) {
  GuideOrder order{.is_on = true};
  order.pulse_n = plain_of(force_n + carrying_n_);
  order.pulse_period_s = kForever_s;
  started_.run().order(order);
}

bool GuidedStimuli::ended_well(core::Fault fault) {
  GuidedRun& run = started_.run();
  // The device is held where it is, and moved back slowly, before the medium disappears.
  GuideOrder back = kFirmHold;
  back.to_m = plain_of(home_m_);
  run.order(back);
  run.render({}, kNoSurface_m);
  if (!core::is_failure(fault)) fault = run.try_for(0.3);
  if (!core::is_failure(fault)) return true;
  // Somebody holds the device until it is armed again.
  started_.act([] {});
  return false;
}

bool GuidedStimuli::is_drawn_through(double damping_n_s_per_m) {
  constexpr double kHalfWay_m = 0.08, kDrawing_n = 6.0, kMost_m_per_s = 0.1, kKnock_n = 3.0;
  const Eigen::Vector3d along = Eigen::Vector3d::UnitX();
  started_.go_to(home_m_ - kHalfWay_m * along, kFirmHold);
  core::MediumAmounts medium;
  medium.damping_n_s_per_m = damping_n_s_per_m;
  GuidedRun& run = started_.run();
  run.render(medium, kNoSurface_m);
  const double drawing_n =
      friction_n_ + std::min(kDrawing_n, damping_n_s_per_m * kMost_m_per_s);
  core::Fault fault = core::Fault::kNone;
  const auto pushed = [&](double force_n, double duration_s) {
    if (core::is_failure(fault)) return;
    push(force_n * along);
    fault = run.try_for(duration_s);
  };
  pushed(drawing_n, 0.4);
  pushed(drawing_n + kKnock_n, 0.01);
  pushed(drawing_n, 0.8);
  return ended_well(fault);
}

bool GuidedStimuli::rests_on(double stiffness_n_per_m) {
  constexpr double kAbove_m = 0.02, kGap_m = 0.005, kPress_n = 5.0, kShake_n = 0.8;
  started_.go_to(home_m_ + kAbove_m * Eigen::Vector3d::UnitZ(), kFirmHold);
  GuidedRun& run = started_.run();
  double lowest_m = std::numeric_limits<double>::infinity();
  run.run_for(0.02, [&](const core::Sample& sample) {
    lowest_m = std::numeric_limits<double>::infinity();
    for (int point = 0; point < core::kNumContactPoints; ++point) {
      if (!started_.can().has_point(point)) continue;
      lowest_m = std::min(lowest_m, sample.tip_position_m[static_cast<std::size_t>(point)][2]);
    }
  });
  run.render(core::solid({.stiffness_n_per_m = stiffness_n_per_m}), lowest_m - kGap_m);
  run.run_for(0.1);
  const Eigen::Vector3d press_n = -kPress_n * Eigen::Vector3d::UnitZ();
  push(press_n);
  core::Fault fault = run.try_for(0.4);
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    if (!started_.can().has_point(point) || core::is_failure(fault)) continue;
    GuideOrder shaken{.is_on = true};
    shaken.pulse_n = plain_of(press_n + carrying_n_);
    shaken.pulse_period_s = kForever_s;
    shaken.sweep_n = kShake_n;
    shaken.sweep_point = point;
    shaken.sweep_axis = 2;
    started_.run().order(shaken);
    fault = run.try_for(0.2);
  }
  push(press_n);
  constexpr double kWatched_s = 0.3, kBetween_s = 0.6;
  Swing early(started_.can()), late(started_.can());
  const auto watch = [&](double duration_s, Swing* swing) {
    if (core::is_failure(fault)) return;
    fault = run.try_for(duration_s, [&](const core::Sample& sample) {
      if (swing != nullptr) swing->add(sample);
    });
  };
  watch(kWatched_s, &early);
  watch(kBetween_s, nullptr);
  watch(kWatched_s, &late);
  // So many standard deviations noise reaches, on either side, in a thousand ticks.
  constexpr double kReach = 4.0;
  const double still_n = device::SettlingCriterion().force_swing_n +
                         2.0 * kReach * stiffness_n_per_m * noise_.position_sd_m.value;
  return ended_well(fault) && late.largest_n() <= std::max(still_n, early.largest_n());
}

}  // namespace jnd::app
