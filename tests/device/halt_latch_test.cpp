#include "device/halt_latch.h"

#include <gtest/gtest.h>

#include <memory>
#include <string>

#include "device/registry/device_registry.h"

namespace jnd::device {
namespace halt_latch_test {

core::PointVectors pushed(double force_n) {
  core::PointVectors all = core::zero_vectors();
  for (Eigen::Vector3d& force : all) force.x() = force_n;
  return all;
}

TEST(HaltLatch, WithholdsUntilNothingIsAskedFor) {
  HaltLatch latch;
  EXPECT_FALSE(latch.withholds(pushed(1.0)));
  latch.halt();
  EXPECT_TRUE(latch.withholds(pushed(1.0)));
  EXPECT_TRUE(latch.withholds(pushed(-1e-12))) << "is a force";
  EXPECT_TRUE(latch.is_halted());
  EXPECT_TRUE(latch.withholds(core::zero_vectors())) << "was halted up to here";
  EXPECT_FALSE(latch.withholds(pushed(1.0)));
}

/// Tests every device whose forces this program computes.
class HaltedDevice : public ::testing::TestWithParam<const char*> {};

TEST_P(HaltedDevice, FeelsNothingUntilZerosAreWritten) {
  const std::unique_ptr<HapticDevice> device = make_device(GetParam(), 1000.0);
  device->open();
  const auto felt_after = [&](int num_writes) {
    const core::ContactSums before = device->contact_sums();
    for (int i = 0; i < num_writes; ++i) {
      core::HapticState state;
      EXPECT_TRUE(device->read(state));
      EXPECT_TRUE(device->write(pushed(0.5)));
    }
    return (device->contact_sums() - before).rendered_opposing_n;
  };
  // The force pushes the hand along, so that the opposing force is negative.
  EXPECT_LT(felt_after(200), 0.0);
  device->halt();
  EXPECT_EQ(felt_after(200), 0.0);
  EXPECT_TRUE(device->write(core::zero_vectors()));
  EXPECT_NE(felt_after(200), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Simulated, HaltedDevice,
                         ::testing::Values("lumped", "mouse", "exoskeleton"));

}  // namespace halt_latch_test
}  // namespace jnd::device
