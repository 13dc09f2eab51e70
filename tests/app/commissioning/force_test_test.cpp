#include "app/commissioning/force_test.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/error.h"
#include "core/safety/emergency_stop.h"
#include "device/twin/twin_device.h"

namespace jnd::app {
namespace force_test_test {

using device::TwinDevice;
const StepProgress kQuiet = [](double, const std::string&) {};

TEST(ForceTestOfADevice, MovesItWhereItIsToldTo) {
  for (int axis = 0; axis < 3; ++axis) {
    TwinDevice twin({.friction_n = 0.05});
    const ForceTestResult result =
        test_force(twin, *twin.bench(), {}, {.along = Eigen::Vector3d::Unit(axis)}, kQuiet);
    // The hand moves by 0.5 N against a spring of 40 N/m.
    EXPECT_NEAR(result.moved_m, 0.0125, 0.002) << axis;
  }
}

TEST(ForceTestOfADevice, IsToldInItsOwnFrame) {
  TwinDevice::Parameters turned{.friction_n = 0.05};
  turned.rotation = Eigen::AngleAxisd(3.14159265, Eigen::Vector3d::UnitZ());
  TwinDevice twin(turned);
  const ForceTest to_the_right{.along = Eigen::Vector3d::UnitX()};
  // The device itself detects no fault, because in its own frame it goes where it is told.
  EXPECT_GT(test_force(twin, *twin.bench(), {}, to_the_right, kQuiet).moved_m, 0.01);
  const ForceTest as_it_is{.along = Eigen::Vector3d::UnitX(), .rotation = turned.rotation};
  EXPECT_GT(test_force(twin, *twin.bench(), {}, as_it_is, kQuiet).moved_m, 0.01);
}

TEST(ForceTestOfADevice, ThatSticksDoesNotMove) {
  TwinDevice twin({.friction_n = 1.5});
  EXPECT_LT(test_force(twin, *twin.bench(), {}, {}, kQuiet).moved_m, 0.0005);
}

TEST(ForceTestOfADevice, IsSmallAndEndsWithTheStop) {
  TwinDevice twin({});
  EXPECT_THROW((void)test_force(twin, *twin.bench(), {}, {.force_n = 2.5}, kQuiet),
               core::Error);
  EXPECT_THROW((void)test_force(twin, *twin.bench(), {},
                                {.along = Eigen::Vector3d(1.0, 1.0, 0.0)}, kQuiet),
               core::Error);
  core::EmergencyStop stop;
  stop.press();
  EXPECT_THROW((void)test_force(twin, *twin.bench(), {.emergency_stop = &stop}, {}, kQuiet),
               core::Error);
}

}  // namespace force_test_test
}  // namespace jnd::app
