#include "device/lumped_hand_device.h"

#include <cmath>

#include "core/require.h"

namespace jnd::device {
namespace {

using core::require;
using core::require_not_negative;
using core::require_positive;

}  // namespace

LumpedHandDevice::LumpedHandDevice(const Parameters& parameters)
    : parameters_(parameters),
      period_s_(core::period_s_at(parameters.rate_hz)),
      arm_(parameters.arm, period_s_),
      hand_(parameters.rate_hz, arm_.arm().reference_m()) {
  require_positive(parameters.mass_kg, "mass_kg");
  require_not_negative(parameters.mechanical_viscosity_n_s_per_m,
                       "mechanical_viscosity_n_s_per_m");
  require_not_negative(parameters.dry_friction_n, "dry_friction_n");
  require_positive(parameters.friction_speed_m_per_s, "friction_speed_m_per_s");
  require_positive(parameters.max_force_per_point_n, "max_force_per_point_n");
  require_positive(parameters.max_total_force_n, "max_total_force_n");
  // Explicit damping is stable below 2 mass / period. Half of that is left to the medium.
  const double damping = parameters.mechanical_viscosity_n_s_per_m +
                         parameters.dry_friction_n / parameters.friction_speed_m_per_s +
                         parameters.arm.damping_n_s_per_m;
  require(damping * period_s_ < parameters.mass_kg, "mass_kg",
          "a number > period * (viscosity + friction / friction speed + arm damping)",
          parameters.mass_kg);
}

DeviceCapabilities LumpedHandDevice::capabilities() const noexcept {
  return {.rate_hz = parameters_.rate_hz,
          .max_force_per_point_n = parameters_.max_force_per_point_n,
          .max_total_force_n = parameters_.max_total_force_n,
          .watchdog_timeout_s = 0.250,
          .simulated = true,
          .moves_by_itself = true};
}

void LumpedHandDevice::open() {
  arm_.reset();
  halt_.reset();
  hand_.rest_at(arm_.arm().reference_m());
}

bool LumpedHandDevice::read(core::HapticState& state) noexcept {
  hand_.read(state);
  return true;
}

bool LumpedHandDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  arm_.follow_orders();
  Eigen::Vector3d rendered_n = Eigen::Vector3d::Zero();
  if (!halt_.withholds(force_on_hand_n)) rendered_n = total_of(force_on_hand_n);
  const Eigen::Vector3d velocity_m_per_s = hand_.velocity_m_per_s();
  double damping_n_s_per_m = parameters_.mechanical_viscosity_n_s_per_m;
  if (parameters_.dry_friction_n > 0.0) {
    damping_n_s_per_m +=
        parameters_.dry_friction_n /
        std::sqrt(velocity_m_per_s.squaredNorm() +
                  parameters_.friction_speed_m_per_s * parameters_.friction_speed_m_per_s);
  }
  hand_.feel(rendered_n, damping_n_s_per_m);

  arm_.advance();
  const Eigen::Vector3d force_n = rendered_n - damping_n_s_per_m * velocity_m_per_s +
                                  arm_.arm().force_n(hand_.position_m(), velocity_m_per_s);
  hand_.move_at(velocity_m_per_s + (period_s_ / parameters_.mass_kg) * force_n);
  return true;
}

}  // namespace jnd::device
