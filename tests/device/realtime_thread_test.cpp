#include "device/realtime_thread.h"

#include <gtest/gtest.h>

#include <atomic>
#include <thread>

#include "core/error.h"
#include "device/fault_injection.h"
#include "device/lumped_hand_device.h"
#include "scripted_device.h"

namespace jnd::device {
namespace {

/// Ticks at whatever the machine gives, which a test must not depend on.
constexpr RealtimeThread::Parameters kModest = {
    .priority = 0, .lock_memory = false, .spin_s = 0.0};

struct Doors {
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
};

TEST(RealtimeThread, SaysWhatItWasNotAskedForWithoutComplaint) {
  const RealtimeThread thread(kModest);
  EXPECT_FALSE(thread.report().realtime_scheduler);
  EXPECT_EQ(thread.report().scheduler, "SCHED_OTHER");
  EXPECT_FALSE(thread.report().memory_locked);
  EXPECT_EQ(thread.report().lacks, "");
}

TEST(RealtimeThread, ReportsEitherTheSchedulerOrWhyItWasRefused) {
  const RealtimeThread thread({.priority = 80, .lock_memory = false});
  const RealtimeReport& report = thread.report();
  EXPECT_EQ(report.realtime_scheduler, report.scheduler == "SCHED_FIFO 80");
  EXPECT_EQ(report.realtime_scheduler, report.lacks.empty()) << report.lacks;
}

TEST(RealtimeThread, ACpuThatDoesNotExistIsReported) {
  const RealtimeThread thread({.priority = 0, .lock_memory = false, .cpu = 1000});
  EXPECT_FALSE(thread.report().pinned);
  EXPECT_NE(thread.report().lacks.find("CPU 1000"), std::string::npos);
}

TEST(RealtimeThread, TicksUntilItIsStoppedAndEveryTickIsTimed) {
  ScriptedDevice device;
  Doors doors;
  HapticLoop loop({}, device, {doors.commands, doors.telemetry, doors.stop});
  RealtimeThread thread(kModest);
  EXPECT_TRUE(device.received.empty()) << "nothing moves before start";
  thread.start(loop);
  while (thread.timing().num_ticks() < 20) std::this_thread::yield();
  thread.stop();
  thread.stop();
  doors.telemetry.fetch();
  EXPECT_EQ(doors.telemetry.value().num_ticks, thread.timing().num_ticks());
  EXPECT_EQ(static_cast<std::int64_t>(device.received.size()), thread.timing().num_ticks());
  EXPECT_GE(thread.timing().lateness().percentile_ns(0.0), 0);
  EXPECT_GT(thread.timing().tick_cost().max_ns(), 0);
}

TEST(RealtimeThread, EndsCleanlyWithoutEverHavingBeenStarted) {
  RealtimeThread thread(kModest);
  thread.stop();
  EXPECT_EQ(thread.timing().num_ticks(), 0);
}

TEST(RealtimeThread, ATickThatTakesTooLongIsCountedAsMissedTicks) {
  ScriptedDevice device;
  FaultInjectingDevice stalling(
      device, {{.first_tick = 5, .injection = Injection::kStall, .magnitude = 0.025}});
  Doors doors;
  HapticLoop loop({}, stalling, {doors.commands, doors.telemetry, doors.stop});
  RealtimeThread thread(kModest);
  thread.start(loop);
  while (thread.timing().num_ticks() < 10) std::this_thread::yield();
  thread.stop();
  EXPECT_GE(thread.timing().missed_ticks(), 23);
  EXPECT_GE(thread.timing().lateness().max_ns(), 24'000'000)
      << "late until its force was written";
}

TEST(RealtimeThread, TheArmTakesItsOrdersFromAnotherThread) {
  LumpedHandDevice hand(LumpedHandDevice::Parameters{.rate_hz = 20'000.0});
  Doors doors;
  HapticLoop loop({.rate_hz = 20'000.0}, hand, {doors.commands, doors.telemetry, doors.stop});
  hand.open();
  RealtimeThread thread(kModest);
  thread.start(loop);
  doors.commands.publish({.sequence = 1, .medium = core::water({})});
  hand.begin_strokes({.amplitude_m = 0.01, .max_speed_m_per_s = 1.0, .num_strokes = 1},
                     core::RandomStream(1, "stroke"));
  while (hand.strokes_finished() < 1) {
    doors.telemetry.fetch();
    std::this_thread::yield();
  }
  thread.stop();
  EXPECT_EQ(hand.strokes_finished(), 1);
  EXPECT_EQ(doors.telemetry.value().fault, core::Fault::kNone);
}

TEST(RealtimeThread, NamesTheParameterItRejects) {
  EXPECT_THROW(RealtimeThread({.priority = 100}), core::Error);
  EXPECT_THROW(RealtimeThread({.cpu = -2}), core::Error);
  EXPECT_THROW(RealtimeThread({.spin_s = -1.0}), core::Error);
}

TEST(RequireRealtime, ARealDeviceIsRefusedWithoutRealTimeUnlessAllowed) {
  ScriptedDevice device;
  const RealtimeReport full = {
      .realtime_scheduler = true, .scheduler = "SCHED_FIFO 80", .memory_locked = true};
  const RealtimeReport no_lock = {.realtime_scheduler = true, .scheduler = "SCHED_FIFO 80"};
  const RealtimeReport nothing = {.scheduler = "SCHED_OTHER"};
  EXPECT_NO_THROW(require_realtime(device, full, false));
  EXPECT_THROW(require_realtime(device, no_lock, false), core::Error);
  EXPECT_THROW(require_realtime(device, nothing, false), core::Error);
  EXPECT_NO_THROW(require_realtime(device, nothing, true));
  device.device_capabilities.simulated = true;
  EXPECT_NO_THROW(require_realtime(device, nothing, false));
}

}  // namespace
}  // namespace jnd::device
