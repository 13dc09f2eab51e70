#include "device/fault_injection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "scripted_device.h"

namespace jnd::device {
namespace fault_injection_test {

core::HapticState read_from(FaultInjectingDevice& device) {
  core::HapticState state;
  EXPECT_TRUE(device.read(state));
  return state;
}

TEST(FaultInjection, WithoutAFaultTheDeviceIsAsItWas) {
  ScriptedDevice inner;
  inner.device_capabilities.simulated = true;
  FaultInjectingDevice device(inner, {});
  device.open();
  EXPECT_EQ(device.name(), "scripted");
  EXPECT_TRUE(device.capabilities().simulated);
  EXPECT_EQ(read_from(device).tip_position_m[0], inner.state.tip_position_m[0]);
  ASSERT_TRUE(device.write(core::zero_vectors()));
  EXPECT_EQ(inner.received.size(), 1U);
}

TEST(FaultInjection, AFaultStrikesInItsTicksAlone) {
  ScriptedDevice inner;
  FaultInjectingDevice device(
      inner, {{.first_tick = 2, .num_ticks = 2, .injection = Injection::kNonFinitePosition}});
  for (int tick = 0; tick < 6; ++tick) {
    const bool struck = std::isnan(read_from(device).tip_position_m[3].y());
    EXPECT_EQ(struck, tick == 2 || tick == 3) << tick;
  }
}

TEST(FaultInjection, AFrozenSampleKeepsItsTimeAndAStaleOneDoesNot) {
  for (const Injection injection : {Injection::kFrozenSample, Injection::kStaleTime}) {
    ScriptedDevice inner;
    inner.move_all({1.0, 0.0, 0.0});
    FaultInjectingDevice device(inner,
                                {{.first_tick = 1, .num_ticks = 2, .injection = injection}});
    const core::HapticState first = read_from(device);
    for (int tick = 1; tick <= 2; ++tick) {
      ASSERT_TRUE(device.write(core::zero_vectors()));
      const core::HapticState state = read_from(device);
      EXPECT_EQ(state.tip_position_m[0], first.tip_position_m[0]);
      EXPECT_EQ(state.device_time_ns > first.device_time_ns,
                injection == Injection::kFrozenSample);
    }
    ASSERT_TRUE(device.write(core::zero_vectors()));
    EXPECT_NE(read_from(device).tip_position_m[0], first.tip_position_m[0]);
  }
}

TEST(FaultInjection, AForceSpikeReachesTheDeviceThoughNobodyAskedForIt) {
  ScriptedDevice inner;
  FaultInjectingDevice device(inner, {{.first_tick = 0,
                                       .injection = Injection::kForceSpike,
                                       .point = core::ContactPoint::kThumb,
                                       .magnitude = 7.0}});
  (void)read_from(device);
  ASSERT_TRUE(device.write(core::zero_vectors()));
  EXPECT_EQ(inner.received[0][2], Eigen::Vector3d(7.0, 0.0, 0.0));
}

TEST(FaultInjection, AFailedWriteDoesNotReachTheDevice) {
  ScriptedDevice inner;
  FaultInjectingDevice device(inner, {{.injection = Injection::kWriteFailure}});
  (void)read_from(device);
  EXPECT_FALSE(device.write(core::zero_vectors()));
  EXPECT_TRUE(inner.received.empty());
}

TEST(FaultInjection, AnOpeningFailsAsOftenAsItWasTold) {
  ScriptedDevice inner;
  FaultInjectingDevice device(inner, {{.num_ticks = 2, .injection = Injection::kOpenFailure}});
  EXPECT_THROW(device.open(), core::Error);
  EXPECT_THROW(device.open(), core::Error);
  EXPECT_EQ(inner.num_opened, 0) << "the motors stay off";
  device.open();
  EXPECT_EQ(inner.num_opened, 1);
  EXPECT_EQ(read_from(device).tip_position_m[0], inner.state.tip_position_m[0]);
}

}  // namespace fault_injection_test
}  // namespace jnd::device
