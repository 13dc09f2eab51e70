#include "experiments/participants/calculated_stroke.h"

#include <array>
#include <cmath>
#include <complex>
#include <numbers>

namespace jnd::experiments {
namespace {

using std::numbers::pi;

/// Forces that are not linear in speed, averaged over a stroke.
struct Nonlinear {
  double damping_n_s_per_m = 0.0;    ///< c(V)
  double delivered_n_s_per_m = 0.0;  ///< Mean force over mean speed.
};

Nonlinear averaged(const core::MediumAmounts& medium, const core::ForceMap* map,
                   double speed_m_per_s) {
  // The average uses the midpoints of a quarter of a stroke, because the quarters are alike.
  constexpr int kNumPhases = 8;
  static const std::array<double, kNumPhases> kSines = [] {
    std::array<double, kNumPhases> sines{};
    for (int i = 0; i < kNumPhases; ++i) {
      sines[static_cast<std::size_t>(i)] = std::sin(0.5 * pi * (i + 0.5) / kNumPhases);
    }
    return sines;
  }();
  double work = 0.0, force = 0.0;
  for (const double sine : kSines) {
    const double speed = speed_m_per_s * sine;
    const double drag_n = medium.drag_n({.velocity_m_per_s = {speed, 0.0, 0.0},
                                         .speed_m_per_s = speed,
                                         .sin_angle_of_attack = 1.0},
                                        map);
    force += drag_n / kNumPhases;
    work += drag_n * sine / kNumPhases;
  }
  return {2.0 * work / speed_m_per_s, 0.5 * pi * force / speed_m_per_s};
}

}  // namespace

CalculatedStroke calculated_stroke(const Laboratory& laboratory, double amplitude_m,
                                   double max_speed_m_per_s, const core::MediumAmounts& medium,
                                   const core::ForceMap* map) {
  const double linear = medium.damping_n_s_per_m + medium.ellipsoid_normal_n_s_per_m;
  core::MediumAmounts rest = medium;
  rest.damping_n_s_per_m = 0.0;
  const Laboratory::Device& device = laboratory.device;
  const double omega = max_speed_m_per_s / amplitude_m;
  const double spring = laboratory.arm.stiffness_n_per_m;
  const double pull = std::abs(std::complex(spring, laboratory.arm.damping_n_s_per_m * omega));
  const double elastic = spring - device.mass_kg * omega * omega;
  // The force against the hand grows with its speed, so bisection finds the only balance.
  double low = 0.0, high = max_speed_m_per_s * (1.0 + 10.0 * pull / (1.0 + std::fabs(elastic)));
  Nonlinear nonlinear;
  constexpr int kMostSteps = 60;
  double speed = max_speed_m_per_s;
  for (int step = 0; step < kMostSteps; ++step) {
    nonlinear = averaged(rest, map, speed);
    const double damping = laboratory.arm.damping_n_s_per_m + linear +
                           nonlinear.damping_n_s_per_m + device.mechanical_viscosity_n_s_per_m +
                           4.0 * device.dry_friction_n / (pi * speed);
    const double follows =
        max_speed_m_per_s * pull / std::abs(std::complex(elastic, damping * omega));
    if (std::fabs(follows - speed) < 1e-9 * max_speed_m_per_s) break;
    (follows > speed ? low : high) = speed;
    // The mean of both values is a good guess if drag grows with speed. If it leaves the
    // interval, bisection takes over.
    speed = 0.5 * (speed + follows);
    if (!(speed > low && speed < high)) speed = 0.5 * (low + high);
  }
  return {.max_speed_m_per_s = speed,
          .delivered_damping_n_s_per_m = linear + nonlinear.delivered_n_s_per_m};
}

}  // namespace jnd::experiments
