#include "core/media/medium.h"

namespace jnd::core {

MediumAmounts water(const WaterDrag::Parameters& parameters) {
  return {.quadratic_kg_per_m = WaterDrag(parameters).quadratic_kg_per_m()};
}

MediumAmounts viscous(const ViscousDrag::Parameters& parameters) {
  return {.damping_n_s_per_m = ViscousDrag(parameters).damping_n_s_per_m()};
}

MediumAmounts solid(const SolidPlane::Parameters& parameters) {
  const SolidPlane plane(parameters);
  return {.plane_stiffness_n_per_m = plane.stiffness_n_per_m(),
          .plane_damping_n_s_per_m = plane.damping_n_s_per_m()};
}

void MediumRamp::start(const MediumAmounts& target, double ramp_s) noexcept {
  target_ = target;
  remaining_s_ = ramp_s;
}

const MediumAmounts& MediumRamp::advance(double period_s) noexcept {
  // A ramp time that is not a number counts as finished, like one that is over.
  if (!(remaining_s_ > period_s)) {
    remaining_s_ = 0.0;
    current_ = target_;
    return current_;
  }
  const double step_ratio = period_s / remaining_s_;
  const auto approach = [step_ratio](double& current, double target) {
    current += step_ratio * (target - current);
  };
  approach(current_.quadratic_kg_per_m, target_.quadratic_kg_per_m);
  approach(current_.damping_n_s_per_m, target_.damping_n_s_per_m);
  approach(current_.plane_stiffness_n_per_m, target_.plane_stiffness_n_per_m);
  approach(current_.plane_damping_n_s_per_m, target_.plane_damping_n_s_per_m);
  remaining_s_ -= period_s;
  return current_;
}

}  // namespace jnd::core
