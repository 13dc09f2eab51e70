// Tests that time which was lost between two ticks is a fault, whatever lost it.

#include <gtest/gtest.h>

#include <thread>

#include "core/media/medium.h"
#include "device/fault_injection.h"
#include "device/haptic_loop.h"
#include "device/realtime_thread.h"
#include "scripted_device.h"

namespace jnd::device {
namespace haptic_loop_stall_test {

class LoopThatLostTime : public ::testing::Test {
 protected:
  LoopThatLostTime() {
    device_.move_all({0.3, 0.0, 0.0});
    commands_.publish(
        {.sequence = 1, .medium = core::viscous({.viscosity_pa_s = 5}), .ramp_s = 0.0});
  }

  void tick(int count) {
    for (int i = 0; i < count; ++i) loop_.tick();
    telemetry_.fetch();
  }
  [[nodiscard]] double last_force_n() const { return total_n(device_.received.back()); }

  static double total_n(const core::PointVectors& forces) {
    double sum_n = 0.0;
    for (const Eigen::Vector3d& force : forces) sum_n += force.norm();
    return sum_n;
  }

  ScriptedDevice device_;
  core::LatestValue<core::HapticCommand> commands_;
  core::LatestValue<core::Telemetry> telemetry_;
  core::EmergencyStop stop_;
  HapticLoop loop_{{.starts_armed = true, .rearm_s = 0.010},
                   device_,
                   {.commands = commands_, .telemetry = telemetry_, .emergency_stop = stop_}};
};

TEST_F(LoopThatLostTime, SendsNothingUntilItIsArmedAgain) {
  tick(50);
  ASSERT_GT(last_force_n(), 0.1);
  loop_.stalled();
  tick(1);
  EXPECT_EQ(last_force_n(), 0.0);
  EXPECT_EQ(telemetry_.value().fault, core::Fault::kWatchdog);
  loop_.rearm(telemetry_.value().num_faults);
  tick(50);
  EXPECT_EQ(telemetry_.value().fault, core::Fault::kNone);
  EXPECT_GT(last_force_n(), 0.1);
}

TEST_F(LoopThatLostTime, TheThreadTellsOfATickThatHeldItUp) {
  for (const auto& [held_up_s, is_fault] : {std::pair(0.002, false), std::pair(0.100, true)}) {
    ScriptedDevice inner;
    inner.move_all({0.3, 0.0, 0.0});
    FaultInjectingDevice device(
        inner, {{.first_tick = 5, .injection = Injection::kStall, .magnitude = held_up_s}});
    HapticLoop loop({.starts_armed = true}, device, {commands_, telemetry_, stop_});
    RealtimeThread thread({.priority = 0,
                           .lock_memory = false,
                           .max_spin_s = 0.0,
                           .max_stall_s = is_fault ? 0.050 : 10.0,
                           .keep_cpus_awake = false});
    thread.start(loop);
    while (thread.timing().num_ticks() < 20) std::this_thread::yield();
    thread.stop();
    telemetry_.fetch();
    EXPECT_EQ(telemetry_.value().fault, is_fault ? core::Fault::kWatchdog : core::Fault::kNone);
    EXPECT_EQ(total_n(inner.received.back()) == 0.0, is_fault);
  }
}

TEST_F(LoopThatLostTime, TheThreadTellsOfATickThatBeganTooLate) {
  // No tick begins within a nanosecond of when it is due, but none here misses a whole period.
  RealtimeThread thread({.priority = 0,
                         .lock_memory = false,
                         .max_spin_s = 0.0,
                         .max_stall_s = 1e-9,
                         .keep_cpus_awake = false});
  HapticLoop slow({.rate_hz = 20.0}, device_,
                  {.commands = commands_, .telemetry = telemetry_, .emergency_stop = stop_});
  thread.start(slow);
  while (thread.timing().num_ticks() < 2) std::this_thread::yield();
  thread.stop();
  telemetry_.fetch();
  EXPECT_EQ(telemetry_.value().fault, core::Fault::kWatchdog);
  EXPECT_EQ(last_force_n(), 0.0);
}

}  // namespace haptic_loop_stall_test
}  // namespace jnd::device
