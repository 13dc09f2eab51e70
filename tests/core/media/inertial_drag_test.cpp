#include "core/media/inertial_drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/error.h"
#include "core/media/medium.h"

namespace jnd::core {
namespace inertial_drag_test {

double drag_n(const InertialDrag& drag, double speed_m_per_s) {
  return drag.damping_n_s_per_m() * speed_m_per_s +
         InertialDrag::drag_n(drag.inertial_n(), speed_m_per_s);
}

TEST(InertialDrag, IsTheDragEquationWithSchillerAndNaumannsCoefficient) {
  const double viscosity = 1.853, density = 1000.0, area = 0.0148, length = 0.1;
  const InertialDrag drag({.viscosity_pa_s = viscosity});
  for (const double speed : {0.01, 0.45, 1.0, 3.0}) {
    const double reynolds = density * speed * length / viscosity;
    const double coefficient = 24.0 / reynolds * (1.0 + 0.15 * std::pow(reynolds, 0.687));
    const double expected = 0.5 * density * speed * speed * area * coefficient;
    EXPECT_NEAR(drag_n(drag, speed), expected, 1e-12 * expected) << speed;
  }
}

TEST(InertialDrag, AtAReynoldsNumberOfOneItAddsFifteenPercent) {
  // 100 v / mu = 1 at 0.1 m/s in 10 Pa s. Creeping flow alone gives 17.76 N s/m, which is 1.776
  // N.
  const InertialDrag drag({.viscosity_pa_s = 10.0});
  EXPECT_NEAR(drag_n(drag, 0.1), 1.15 * 1.776, 1e-12);
}

TEST(InertialDrag, GroupDOfTheThesisWouldFeelMoreThanTwiceAsMuch) {
  const InertialDrag drag({.viscosity_pa_s = 1.853});
  const double ratio = drag_n(drag, 0.45) / (drag.damping_n_s_per_m() * 0.45);
  EXPECT_GT(ratio, 2.2);
  EXPECT_LT(ratio, 2.5);
}

TEST(InertialDrag, SaysUpToWhichSpeedItHolds) {
  EXPECT_NEAR(InertialDrag({.viscosity_pa_s = 0.5}).max_speed_m_per_s(), 4.0, 1e-12);
  EXPECT_EQ(InertialDrag({.viscosity_pa_s = 0.0}).max_speed_m_per_s(), 0.0);
}

TEST(InertialDrag, WithoutViscosityThereIsNone) {
  EXPECT_EQ(drag_n(InertialDrag({.viscosity_pa_s = 0.0}), 1.0), 0.0);
}

TEST(InertialDrag, NamesTheParameterItRejects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {-1.0, nan, infinity}) {
    EXPECT_THROW(InertialDrag({.viscosity_pa_s = wrong}), Error) << wrong;
    EXPECT_THROW(InertialDrag({.viscosity_pa_s = 1.0, .density_kg_per_m3 = wrong}), Error);
    EXPECT_THROW(InertialDrag({.viscosity_pa_s = 1.0, .projected_area_m2 = wrong}), Error);
    EXPECT_THROW(InertialDrag({.viscosity_pa_s = 1.0, .length_m = wrong}), Error);
  }
}

}  // namespace inertial_drag_test
}  // namespace jnd::core
