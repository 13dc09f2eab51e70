#include "core/media/viscous_drag.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.h"

namespace jnd::core {
namespace viscous_drag_test {

TEST(ViscousDrag, TheShapeConstantsAreThoseOfTheThesis) {
  // The thesis, B.4, gives 1.7760 and 1.2322 m.
  EXPECT_NEAR(ViscousDrag({.viscosity_pa_s = 1.0}).shape_constant_m(), 1.7760, 1e-12);
  EXPECT_NEAR(ViscousDrag({.viscosity_pa_s = 1.0, .shape = ViscousDrag::Shape::kSphere})
                  .shape_constant_m(),
              1.2322, 5e-5);
  EXPECT_NEAR(equal_surface_radius_m(0.10, 0.05), 0.06537, 5e-6);
}

TEST(ViscousDrag, ANearlySphericalSpheroidHasTheRadiusOfItsSphere) {
  EXPECT_NEAR(equal_surface_radius_m(0.0500001, 0.05), 0.05, 1e-6);
}

TEST(ViscousDrag, FollowsFromCreepingFlowPutIntoTheDragEquation) {
  const double viscosity = 1.853, speed = 0.45, area = 0.0148, length = 0.1, density = 1000.0;
  const double reynolds = density * speed * length / viscosity;
  const double force = 0.5 * density * speed * speed * area * (24.0 / reynolds);
  EXPECT_NEAR(ViscousDrag({.viscosity_pa_s = viscosity}).drag_n(speed), force, 1e-12);
}

TEST(ViscousDrag, IsLinearInSpeedAndViscosity) {
  const ViscousDrag thin({.viscosity_pa_s = 1.0});
  const ViscousDrag thick({.viscosity_pa_s = 10.0});
  EXPECT_NEAR(thick.drag_n(0.2), 10.0 * thin.drag_n(0.2), 1e-14);
  EXPECT_NEAR(thin.drag_n(0.4), 2.0 * thin.drag_n(0.2), 1e-14);
  EXPECT_EQ(thick.drag_n(0.0), 0.0);
}

TEST(ViscousDrag, NamesTheParameterItRejects) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double wrong : {-1.0, nan, infinity}) {
    EXPECT_THROW(ViscousDrag({.viscosity_pa_s = wrong}), Error) << wrong;
    EXPECT_THROW(ViscousDrag({.viscosity_pa_s = 1.0, .projected_area_m2 = wrong}), Error);
  }
  EXPECT_THROW(ViscousDrag({.viscosity_pa_s = 1.0, .length_m = 0.0}), Error);
  // A sphere has no different semi-axes.
  EXPECT_THROW(ViscousDrag({.viscosity_pa_s = 1.0,
                            .shape = ViscousDrag::Shape::kSphere,
                            .semi_major_axis_m = 0.05}),
               Error);
}

}  // namespace viscous_drag_test
}  // namespace jnd::core
