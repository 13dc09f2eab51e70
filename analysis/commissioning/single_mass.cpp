#include "analysis/commissioning/single_mass.h"

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace jnd::analysis {
namespace {

struct Motion {
  double position_m = 0.0, velocity_m_per_s = 0.0;
};

/// Moves the mass under a constant force for this duration.
void move(const SingleMass& device, double force_n, double duration_s, Motion& motion) {
  const double rate = device.damping_n_s_per_m / device.mass_kg;
  const double turned = rate * duration_s;
  // These are (1 - exp(-t)) / t and (t - 1 + exp(-t)) / t^2, which tend to 1 and 1/2 as t tends
  // to 0.
  constexpr double kSmall = 1e-4;
  const double first = turned < kSmall ? 1.0 - 0.5 * turned : -std::expm1(-turned) / turned;
  const double second =
      turned < kSmall ? 0.5 - turned / 6.0 : (turned + std::expm1(-turned)) / (turned * turned);
  const double push = force_n / device.mass_kg * duration_s;
  motion.position_m += duration_s * (first * motion.velocity_m_per_s + second * push);
  motion.velocity_m_per_s = std::exp(-turned) * motion.velocity_m_per_s + first * push;
}

/// The largest magnitude of an eigenvalue of one period's motion at this stiffness.
double growth_of(const SingleMass& device, double stiffness_n_per_m) {
  const double delay = device.delay_s / device.period_s;
  const auto whole = static_cast<Eigen::Index>(std::floor(delay));
  const double late_s = (delay - static_cast<double>(whole)) * device.period_s;
  // The state holds position, velocity, and the forces of the last writes.
  const Eigen::Index size = 2 + whole + 1;
  Eigen::MatrixXd period(size, size);
  for (Eigen::Index column = 0; column < size; ++column) {
    const Eigen::VectorXd before = Eigen::VectorXd::Unit(size, column);
    const double now_n = -stiffness_n_per_m * before[0];
    const auto written_n = [&](Eigen::Index ticks_ago) {
      return ticks_ago == 0 ? now_n : before[1 + ticks_ago];
    };
    Motion motion{.position_m = before[0], .velocity_m_per_s = before[1]};
    move(device, written_n(whole + 1), late_s, motion);
    move(device, written_n(whole), device.period_s - late_s, motion);
    period(0, column) = motion.position_m;
    period(1, column) = motion.velocity_m_per_s;
    period(2, column) = now_n;
    for (Eigen::Index i = 3; i < size; ++i) period(i, column) = before[i - 1];
  }
  return period.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

bool is_single_mass(const DelayFit& delay, const ForceFit& force) noexcept {
  // Without noise an interval has no width.
  constexpr double kNoTime_s = 2e-5;
  return delay.delay_s.ci95_high > -kNoTime_s && force.damps_alike;
}

double stiffness_limit_n_per_m(const SingleMass& device) {
  if (!(device.damping_n_s_per_m > 0.0)) return 0.0;
  constexpr double kFirst_n_per_m = 1e-3, kStep = 1.1, kLast_n_per_m = 1e9;
  double stable = 0.0, unstable = kFirst_n_per_m;
  while (unstable < kLast_n_per_m && growth_of(device, unstable) < 1.0) {
    stable = unstable;
    unstable *= kStep;
  }
  constexpr int kHalvings = 40;
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (stable + unstable);
    (growth_of(device, middle) < 1.0 ? stable : unstable) = middle;
  }
  return stable;
}

Measured stiffness_limit(const DelayFit& delay, const ForceFit& force, double period_s) {
  const double gain = force.gain.value;
  const auto of = [&](double mass_kg, double damping_n_s_per_m, double delay_s) {
    return stiffness_limit_n_per_m({.mass_kg = mass_kg,
                                    .damping_n_s_per_m = damping_n_s_per_m / gain,
                                    .delay_s = std::max(0.0, delay_s),
                                    .period_s = period_s});
  };
  const Measured& mass = delay.mass_per_gain_kg;
  const Measured& damping = force.damping_n_s_per_m;
  // More damping and less delay help. The mass hardly matters, and may act in either direction.
  const auto over_masses = [&](double damping_n_s_per_m, double delay_s) {
    return std::minmax({of(mass.ci95_low, damping_n_s_per_m, delay_s),
                        of(mass.value, damping_n_s_per_m, delay_s),
                        of(mass.ci95_high, damping_n_s_per_m, delay_s)});
  };
  return {.value = of(mass.value, damping.value, delay.delay_s.value),
          .ci95_low = over_masses(damping.ci95_low, delay.delay_s.ci95_high).first,
          .ci95_high = over_masses(damping.ci95_high, delay.delay_s.ci95_low).second};
}

}  // namespace jnd::analysis
