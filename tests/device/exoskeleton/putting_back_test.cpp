#include <gtest/gtest.h>

#include "device/exoskeleton/exoskeleton_device.h"
#include "device/fault_injection.h"

namespace jnd::device {
namespace putting_back_test {

bool all_hold_within(HapticDevice& device, int num_ticks) {
  core::HapticState state;
  for (int tick = 0; tick < num_ticks; ++tick) {
    EXPECT_TRUE(device.read(state));
    if (state.attached == core::kAllAttached) return true;
    EXPECT_TRUE(device.write(core::zero_vectors()));
  }
  return false;
}

TEST(PuttingBack, ASimulatedPersonPutsFingersBackThatCameOff) {
  ExoskeletonDevice exoskeleton({});
  exoskeleton.detach(0);
  exoskeleton.detach(3);
  EXPECT_FALSE(all_hold_within(exoskeleton, 500)) << "not by themselves";
  exoskeleton.simulated_hand()->put_fingers_back();
  EXPECT_TRUE(all_hold_within(exoskeleton, 3000));
}

TEST(PuttingBack, IsDoneOnceForEachTimeItIsAskedFor) {
  ExoskeletonDevice exoskeleton({});
  exoskeleton.simulated_hand()->put_fingers_back();
  EXPECT_TRUE(exoskeleton.write(core::zero_vectors()));
  exoskeleton.detach(3);
  EXPECT_FALSE(all_hold_within(exoskeleton, 500));
}

TEST(PuttingBack, ReachesTheHandThroughInjectedFaults) {
  ExoskeletonDevice exoskeleton({});
  FaultInjectingDevice device(exoskeleton, {});
  EXPECT_EQ(device.simulated_hand(), exoskeleton.simulated_hand());
  EXPECT_EQ(device.fault(), core::Fault::kNone);
  exoskeleton.detach(3);
  device.simulated_hand()->put_fingers_back();
  EXPECT_TRUE(all_hold_within(device, 3000));
}

}  // namespace putting_back_test
}  // namespace jnd::device
