#include "core/media/medium.h"

#include <algorithm>
#include <cmath>

#include "core/require.h"

namespace jnd::core {

bool MediumAmounts::is_drag_of_motion() const noexcept {
  return std::ranges::all_of(kAmounts, [this](auto amount) {
    return this->*amount == 0.0 ||
           std::ranges::find(kDragOfMotion, amount) != kDragOfMotion.end();
  });
}

bool MediumAmounts::is_plain_damping() const noexcept {
  MediumAmounts rest = *this;
  rest.damping_n_s_per_m = 0.0;
  return std::ranges::all_of(kAmounts, [&](auto amount) { return rest.*amount == 0.0; });
}

bool MediumAmounts::is_finite() const noexcept {
  return std::ranges::all_of(kAmounts,
                             [&](auto amount) { return std::isfinite(this->*amount); });
}

bool MediumAmounts::is_nowhere_more_than(const MediumAmounts& other) const noexcept {
  return std::ranges::all_of(kAmounts, [&](auto amount) {
    return std::abs(this->*amount) <= std::abs(other.*amount);
  });
}

MediumAmounts MediumAmounts::times(double factor) const noexcept {
  MediumAmounts all = *this;
  for (double MediumAmounts::*const amount : kAmounts) all.*amount *= factor;
  return all;
}

MediumAmounts& MediumAmounts::operator+=(const MediumAmounts& other) noexcept {
  for (const auto amount : kAmounts) this->*amount += other.*amount;
  return *this;
}

MediumAmounts water(const WaterDrag::Parameters& parameters) {
  return {.quadratic_kg_per_m = WaterDrag(parameters).quadratic_kg_per_m()};
}

MediumAmounts mapped_water(const WaterDrag::Parameters& parameters) {
  const double quadratic_kg_per_m = WaterDrag(parameters).quadratic_kg_per_m();
  return {.mapped_drag_kg_per_m = quadratic_kg_per_m, .lift_kg_per_m = quadratic_kg_per_m};
}

MediumAmounts viscous(const ViscousDrag::Parameters& parameters) {
  return {.damping_n_s_per_m = ViscousDrag(parameters).damping_n_s_per_m()};
}

MediumAmounts viscous_inertial(const InertialDrag::Parameters& parameters) {
  const InertialDrag drag(parameters);
  return {.damping_n_s_per_m = drag.damping_n_s_per_m(), .inertial_n = drag.inertial_n()};
}

MediumAmounts ellipsoid(const EllipsoidDrag::Parameters& parameters) {
  const EllipsoidDrag drag(parameters);
  return {.ellipsoid_fingers_n_s_per_m = drag.damping_n_s_per_m()[0],
          .ellipsoid_across_n_s_per_m = drag.damping_n_s_per_m()[1],
          .ellipsoid_normal_n_s_per_m = drag.damping_n_s_per_m()[2]};
}

MediumAmounts solid(const SolidParameters& parameters) {
  const SolidAmounts amounts = solid_amounts(parameters);
  return {.plane_stiffness_n_per_m = amounts.stiffness_n_per_m,
          .plane_damping_n_s_per_m = amounts.damping_n_s_per_m,
          .plane_friction_n_per_m = amounts.friction_n_per_m};
}

MediumAmounts container(const SolidParameters& parameters) {
  const SolidAmounts amounts = solid_amounts(parameters);
  return {.container_stiffness_n_per_m = amounts.stiffness_n_per_m,
          .container_damping_n_s_per_m = amounts.damping_n_s_per_m,
          .container_friction_n_per_m = amounts.friction_n_per_m};
}

MediumAmounts buoyant(double buoyancy_n) {
  require_not_negative(buoyancy_n, "buoyancy_n");
  return {.buoyancy_n = buoyancy_n};
}

void MediumRamp::start(const MediumAmounts& target, double ramp_s) noexcept {
  target_ = target;
  remaining_s_ = ramp_s;
  arrived_ = false;
}

const MediumAmounts& MediumRamp::advance(double elapsed_s) noexcept {
  if (arrived_) return current_;
  // A remaining time that is not a number ends the ramp like one that is over.
  if (!(remaining_s_ > elapsed_s)) {
    arrived_ = true;
    current_ = target_;
    return current_;
  }
  const double step_ratio = elapsed_s / remaining_s_;
  for (const auto amount : kAmounts) {
    current_.*amount += step_ratio * (target_.*amount - current_.*amount);
  }
  remaining_s_ -= elapsed_s;
  return current_;
}

}  // namespace jnd::core
