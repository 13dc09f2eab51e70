#include "device/mouse_device.h"

#include <algorithm>
#include <cmath>

#include "core/require.h"

namespace jnd::device {
namespace {

using core::require;
using core::require_not_negative;
using core::require_positive;

Eigen::Vector3d horizontal(const Eigen::Vector2d& vector, double z) noexcept {
  return {vector.x(), vector.y(), z};
}

/// Returns the damping that is equivalent to a force against the motion at this velocity, and 0
/// for a push.
double damping_of(const Eigen::Vector3d& force_n,
                  const Eigen::Vector3d& velocity_m_per_s) noexcept {
  constexpr double kAtRestM2PerS2 = 1e-12;
  const double squared_m2_per_s2 = velocity_m_per_s.squaredNorm();
  if (squared_m2_per_s2 < kAtRestM2PerS2) return 0.0;
  return std::max(0.0, -force_n.dot(velocity_m_per_s) / squared_m2_per_s2);
}

}  // namespace

MouseDevice::MouseDevice(const Parameters& parameters,
                         core::LatestValue<core::PointerPosition>* pointer)
    : parameters_(parameters),
      pointer_(pointer != nullptr ? pointer : &own_pointer_),
      guide_(parameters.guide, core::period_s_at(parameters.rate_hz)),
      hand_(parameters.rate_hz, {0.0, 0.0, parameters.height_m}) {
  require_positive(parameters.mass_kg, "mass_kg");
  require_positive(parameters.stiffness_n_per_m, "stiffness_n_per_m");
  require_not_negative(parameters.damping_n_s_per_m, "damping_n_s_per_m");
  require(std::isfinite(parameters.height_m), "height_m", "a finite number",
          parameters.height_m);
  require_positive(parameters.max_speed_m_per_s, "max_speed_m_per_s");
  require_positive(parameters.max_force_per_point_n, "max_force_per_point_n");
  require_positive(parameters.max_total_force_n, "max_total_force_n");
  // The explicit spring and damper are then stable with a margin.
  const double period_s = hand_.period_s();
  require((parameters.damping_n_s_per_m + parameters.stiffness_n_per_m * period_s) * period_s <
              parameters.mass_kg,
          "mass_kg", "a number > period * (damping + period * stiffness)", parameters.mass_kg);
}

DeviceCapabilities MouseDevice::capabilities() const noexcept {
  return {.rate_hz = parameters_.rate_hz,
          .max_force_per_point_n = parameters_.max_force_per_point_n,
          .max_total_force_n = parameters_.max_total_force_n,
          // Its force is seen and not felt, so a busy machine need not stop it.
          .watchdog_timeout_s = 2.0,
          .heartbeat_timeout_s = 2.0,
          .simulated = true};
}

void MouseDevice::open() {
  guide_ = PointerGuide(parameters_.guide, hand_.period_s());
  hand_.rest_at({0.0, 0.0, parameters_.height_m});
  halt_.reset();
}

bool MouseDevice::read(core::HapticState& state) noexcept {
  hand_.read(state);
  return true;
}

bool MouseDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  const Eigen::Vector3d velocity_m_per_s = hand_.velocity_m_per_s();
  Eigen::Vector3d rendered_n = Eigen::Vector3d::Zero();
  if (!halt_.withholds(force_on_hand_n)) rendered_n = total_of(force_on_hand_n);
  hand_.feel(rendered_n, 0.0);
  rendered_n.z() = 0.0;  // The hand keeps its height.

  const Eigen::Vector3d before_m_per_s = horizontal(guide_.velocity_m_per_s(), 0.0);
  pointer_->fetch();
  guide_.advance(pointer_->value());
  const Eigen::Vector3d pointer_m = horizontal(guide_.position_m(), parameters_.height_m);
  const Eigen::Vector3d pointer_m_per_s = horizontal(guide_.velocity_m_per_s(), 0.0);

  const double damping_n_s_per_m = damping_of(rendered_n, velocity_m_per_s);
  const Eigen::Vector3d force_n =
      rendered_n + damping_n_s_per_m * velocity_m_per_s +
      parameters_.stiffness_n_per_m * (pointer_m - hand_.position_m()) +
      parameters_.damping_n_s_per_m * (pointer_m_per_s - velocity_m_per_s);
  const double period_per_mass = hand_.period_s() / parameters_.mass_kg;
  Eigen::Vector3d next_m_per_s =
      (velocity_m_per_s + (pointer_m_per_s - before_m_per_s) + period_per_mass * force_n) /
      (1.0 + period_per_mass * damping_n_s_per_m);
  const double speed_m_per_s = next_m_per_s.norm();
  if (speed_m_per_s > parameters_.max_speed_m_per_s) {
    next_m_per_s *= parameters_.max_speed_m_per_s / speed_m_per_s;
  }
  hand_.move_at(next_m_per_s);
  return true;
}

}  // namespace jnd::device
