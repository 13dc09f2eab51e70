#include "experiments/participants/calculated_stroke.h"
#include "experiments/participants/thesis_laboratory.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace jnd::experiments {
namespace calculated_stroke_test {

using std::numbers::pi;

TEST(CalculatedStroke, AViscousFluidIsDeliveredAsItsDampingWhateverTheSpeed) {
  for (const double speed : {0.1, 0.45, 2.0}) {
    EXPECT_DOUBLE_EQ(calculated_stroke(thesis_laboratory(), 0.3, speed,
                                       core::viscous({.viscosity_pa_s = 10.0}))
                         .delivered_damping_n_s_per_m,
                     core::viscous({.viscosity_pa_s = 10.0}).damping_n_s_per_m);
  }
}

TEST(CalculatedStroke, AStiffArmMovesTheHandAsItsReference) {
  Laboratory stiff = thesis_laboratory();
  stiff.arm.stiffness_n_per_m = 1e7;
  // Water head on: q = 1/2 rho A C_D = 6.5853 N at 1 m/s, which delivers pi/4 q V.
  const CalculatedStroke stroke =
      calculated_stroke(stiff, 0.164, 0.437, core::water({.scale = 1.0}));
  EXPECT_NEAR(stroke.max_speed_m_per_s, 0.437, 1e-5);
  EXPECT_NEAR(stroke.delivered_damping_n_s_per_m, 0.25 * pi * 7.4 * 0.8899 * 0.437, 1e-4);
}

TEST(CalculatedStroke, AHandWithoutMediumAndFrictionIsTheLinearOscillatorOfTheTextbook) {
  Laboratory free = thesis_laboratory();
  free.device.dry_friction_n = 0.0;
  const double amplitude = 0.2, speed = 0.5, omega = 2.5;
  const double k = free.arm.stiffness_n_per_m, d = free.arm.damping_n_s_per_m;
  const double m = free.device.mass_kg, b = free.device.mechanical_viscosity_n_s_per_m;
  const double expected =
      speed * std::hypot(k, d * omega) / std::hypot(k - m * omega * omega, (d + b) * omega);
  EXPECT_NEAR(calculated_stroke(free, amplitude, speed, core::free_space()).max_speed_m_per_s,
              expected, 1e-8);
}

TEST(CalculatedStroke, BalancesTheWorkOfWaterAndFrictionInOneSine) {
  const Laboratory here = thesis_laboratory();
  for (const double scale : {0.5, 4.0, 40.0}) {
    const core::MediumAmounts water = core::water({.scale = scale});
    const CalculatedStroke stroke = calculated_stroke(here, 0.164, 0.437, water);
    const double v = stroke.max_speed_m_per_s, omega = 0.437 / 0.164;
    const double q = 7.4 * 0.8899 * scale;
    const double damping = here.arm.damping_n_s_per_m + 8.0 / (3.0 * pi) * q * v +
                           here.device.mechanical_viscosity_n_s_per_m +
                           4.0 * here.device.dry_friction_n / (pi * v);
    const double k = here.arm.stiffness_n_per_m;
    EXPECT_NEAR(v * std::hypot(k - here.device.mass_kg * omega * omega, damping * omega),
                0.437 * std::hypot(k, here.arm.damping_n_s_per_m * omega), 2e-3 * k)
        << scale;
    EXPECT_LT(v, 0.5);
  }
}

TEST(CalculatedStroke, ThickerMediaSlowTheHandDown) {
  double before = 1e9;
  for (const double scale : {0.0, 0.5, 1.0, 2.0, 4.0, 100.0}) {
    const double speed =
        calculated_stroke(thesis_laboratory(), 0.164, 0.437, core::water({.scale = scale}))
            .max_speed_m_per_s;
    EXPECT_LT(speed, before);
    before = speed;
  }
}

}  // namespace calculated_stroke_test
}  // namespace jnd::experiments
