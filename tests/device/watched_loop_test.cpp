#include <gtest/gtest.h>

#include <memory>

#include "core/media/medium.h"
#include "core/safety/watchdog_state.h"
#include "device/haptic_loop.h"
#include "device/scripted_device.h"
#include "device/watchdog.h"

namespace jnd::device {
namespace watched_loop_test {

/// A loop that a watchdog watches in simulated time. The device records what it received.
class WatchedLoopTest : public ::testing::TestWithParam<int> {
 protected:
  class Device final : public HapticDevice {
   public:
    [[nodiscard]] std::string_view name() const noexcept override { return "watched"; }
    [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
      return {.simulated = true};
    }
    void open() override {}
    [[nodiscard]] bool read(core::HapticState& measured) noexcept override {
      return scripted.read(measured);
    }
    [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
      return scripted.write(force_on_hand_n);
    }
    void close() noexcept override {}
    void halt() noexcept override { scripted.received.push_back(core::zero_vectors()); }
    ScriptedDevice scripted;
  };

  void SetUp() override {
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      device.scripted.state.attached[i] = i < GetParam();
    }
    device.scripted.move_all({0.3, 0.0, 0.0});
    commands.publish({.sequence = 1,
                      .medium = core::viscous({.viscosity_pa_s = 8.0}),
                      .immersion = {.radius_m = 10.0, .depth_m = 10.0},
                      .ramp_s = 0.0});
    run(200);
    ASSERT_GT(total_n(), 0.5);
  }
  void run(int num_ms, bool ticks = true) {
    for (int i = 0; i < num_ms; ++i) {
      now_ns += 1'000'000;
      if (ticks) loop.tick();
      if (now_ns / 1'000'000 % 2 == 0) watchdog.look(now_ns);
    }
  }
  [[nodiscard]] double total_n() const {
    double total = 0.0;
    for (const Eigen::Vector3d& force : device.scripted.received.back()) total += force.norm();
    return total;
  }
  core::Fault fault() {
    telemetry.fetch();
    return telemetry.value().fault;
  }

  Device device;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  core::WatchdogState state;
  HapticLoop loop{
      {.starts_armed = true}, device, {commands, telemetry, stop, nullptr, nullptr, &state}};
  Watchdog watchdog{{}, device, state};
  std::int64_t now_ns = 0;
};

TEST_P(WatchedLoopTest, AShortStallIsNoFault) {
  for (const int num_ms : {2, 10}) {
    run(num_ms, false);
    run(50);
    EXPECT_EQ(fault(), core::Fault::kNone) << num_ms;
    EXPECT_GT(total_n(), 0.5) << num_ms;
  }
}

TEST_P(WatchedLoopTest, ALongStallTakesTheForceUntilTheLoopIsArmed) {
  for (const int num_ms : {50, 1000}) {
    run(22, false);
    EXPECT_EQ(total_n(), 0.0);
    run(num_ms - 22, false);
    const std::size_t awake = device.scripted.received.size();
    run(100);
    for (std::size_t i = awake; i < device.scripted.received.size(); ++i) {
      for (const Eigen::Vector3d& force : device.scripted.received[i]) {
        EXPECT_EQ(force.norm(), 0.0);
      }
    }
    EXPECT_EQ(fault(), core::Fault::kWatchdog);
    loop.rearm(telemetry.value().num_faults);
    run(700);
    EXPECT_EQ(fault(), core::Fault::kNone);
    EXPECT_GT(total_n(), 0.5);
  }
}

TEST_P(WatchedLoopTest, ALoopThatDiesLeavesNoForce) {
  run(5000, false);
  EXPECT_EQ(total_n(), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Points, WatchedLoopTest, ::testing::Values(1, 3, 5));

}  // namespace watched_loop_test
}  // namespace jnd::device
