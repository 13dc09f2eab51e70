#include "device/realtime_thread.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sched.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "device/fault_injection.h"
#include "device/lumped_hand_device.h"
#include "scripted_device.h"

namespace jnd::device {
namespace realtime_thread_test {

/// The thread ticks at whatever priority the machine gives it, as a test must not depend on
/// more.
constexpr RealtimeThread::Parameters kModest = {
    .priority = 0, .lock_memory = false, .max_spin_s = 0.0, .keep_cpus_awake = false};

struct Exchange {
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
  Exchange exchange;
  HapticLoop loop({.starts_armed = true}, device,
                  {exchange.commands, exchange.telemetry, exchange.stop});
  RealtimeThread thread(kModest);
  EXPECT_TRUE(device.received.empty()) << "nothing moves before start";
  thread.start(loop);
  while (thread.timing().num_ticks() < 20) std::this_thread::yield();
  thread.stop();
  thread.stop();
  exchange.telemetry.fetch();
  EXPECT_EQ(exchange.telemetry.value().num_ticks, thread.timing().num_ticks());
  EXPECT_EQ(static_cast<std::int64_t>(device.received.size()), thread.timing().num_ticks());
  EXPECT_GE(thread.timing().lateness().percentile_ns(0.0), 0);
  EXPECT_GT(thread.timing().tick_cost().max_ns(), 0);
}

/// A read blocks for 15 of every 50 ms. The ticks that never ran are counted between the
/// others.
TEST(RealtimeThread, TheNumbersOfTheTicksAreTime) {
  ScriptedDevice device;
  int num_reads = 0;
  device.while_read = [&] {
    if (++num_reads % 35 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(15));
  };
  Exchange exchange;
  core::SpscQueue<core::Sample> samples(4096);
  HapticLoop loop({.starts_armed = true}, device,
                  {exchange.commands, exchange.telemetry, exchange.stop, &samples});
  RealtimeThread thread(kModest);
  thread.start(loop);
  while (thread.timing().num_ticks() < 700) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  thread.stop();
  exchange.telemetry.fetch();
  const core::Telemetry& last = exchange.telemetry.value();
  EXPECT_GT(last.num_missed_ticks, 200) << "19 times about 14";
  EXPECT_EQ(last.sample.tick + 1, last.num_ticks + last.num_missed_ticks);
  std::optional<core::Sample> first, before;
  std::vector<double> late_ns;
  samples.drain([&](const core::Sample& sample) {
    if (before) {
      EXPECT_EQ(sample.tick, before->tick + 1 + sample.num_missed_before);
      EXPECT_GT(sample.monotonic_ns, before->monotonic_ns);
    }
    if (!first) first = sample;
    late_ns.push_back(static_cast<double>(sample.monotonic_ns - first->monotonic_ns) -
                      1e6 * static_cast<double>(sample.tick - first->tick));
    before = sample;
  });
  ASSERT_TRUE(before);
  // Single ticks, also the first ones, may be late by many periods on a machine that others
  // use.
  std::ranges::nth_element(late_ns, late_ns.begin() + std::ssize(late_ns) / 2);
  EXPECT_NEAR(late_ns[late_ns.size() / 2], 0.0, 5e6);
}

std::atomic<std::int64_t> slept_ns = 0;

std::int64_t clock_that_goes_on_in_sleep() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return std::int64_t{now.tv_sec} * 1'000'000'000 + now.tv_nsec + slept_ns;
}

TEST(RealtimeThread, SleepOfTheMachineIsAFault) {
  ScriptedDevice device;
  Exchange exchange;
  HapticLoop loop({.starts_armed = true}, device,
                  {exchange.commands, exchange.telemetry, exchange.stop});
  RealtimeThread::Parameters parameters = kModest;
  parameters.boottime_ns = clock_that_goes_on_in_sleep;
  slept_ns = 7'000'000'000;  // The machine slept before the thread began.
  RealtimeThread thread(parameters);
  thread.start(loop);
  while (thread.timing().num_ticks() < 20) std::this_thread::yield();
  exchange.telemetry.fetch();
  EXPECT_EQ(exchange.telemetry.value().fault, core::Fault::kNone);
  slept_ns = 10'000'000'000;
  const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (exchange.telemetry.value().fault == core::Fault::kNone &&
         std::chrono::steady_clock::now() < patience) {
    std::this_thread::yield();
    exchange.telemetry.fetch();
  }
  thread.stop();
  EXPECT_EQ(exchange.telemetry.value().fault, core::Fault::kSuspended);
}

TEST(RealtimeThread, ReportsTheCpusItMayRunOn) {
  const RealtimeThread anywhere(kModest);
  cpu_set_t mine;
  ASSERT_EQ(::sched_getaffinity(0, sizeof mine, &mine), 0);
  const std::vector<int>& cpus = anywhere.report().cpus;
  ASSERT_EQ(static_cast<int>(cpus.size()), CPU_COUNT(&mine));
  EXPECT_FALSE(anywhere.report().pinned);

  RealtimeThread::Parameters pinned = kModest;
  pinned.cpu = cpus.back();
  const RealtimeThread there(pinned);
  EXPECT_TRUE(there.report().pinned);
  EXPECT_EQ(there.report().cpus, std::vector<int>{cpus.back()});
  ASSERT_EQ(::sched_getaffinity(0, sizeof mine, &mine), 0);
  EXPECT_EQ(static_cast<int>(cpus.size()), CPU_COUNT(&mine)) << "this thread stays free";
}

TEST(RealtimeThread, ReportsThePriorityThatIsInForce) {
  const RealtimeThread thread({.priority = 42, .lock_memory = false});
  if (!thread.report().realtime_scheduler) {
    EXPECT_EQ(thread.report().priority, 0);
    GTEST_SKIP() << thread.report().lacks;
  }
  EXPECT_EQ(thread.report().priority, 42);
  EXPECT_EQ(thread.report().scheduler, "SCHED_FIFO 42");
}

/// The lowest limit of latency that any program asks for now, in us; nothing if it cannot be
/// read.
std::optional<std::int32_t> latency_asked_for_us() {
  const int file = ::open("/dev/cpu_dma_latency", O_RDONLY | O_CLOEXEC);
  if (file < 0) return std::nullopt;
  std::int32_t latency_us = -1;
  const bool read = ::read(file, &latency_us, sizeof latency_us) == sizeof latency_us;
  ::close(file);
  return read ? std::optional(latency_us) : std::nullopt;
}

TEST(RealtimeThread, KeepsTheCpusAwakeWhereItMay) {
  RealtimeThread::Parameters awake = kModest;
  awake.keep_cpus_awake = true;
  RealtimeThread thread(awake);
  EXPECT_EQ(thread.report().lacks, "") << "a wish, and no lack";
  EXPECT_EQ(thread.report().cpus_kept_awake, ::access("/dev/cpu_dma_latency", W_OK) == 0);
  if (!thread.report().cpus_kept_awake) GTEST_SKIP() << "not allowed here";
  EXPECT_EQ(latency_asked_for_us(), 0);
}

TEST(RealtimeThread, KnowsWhatItUsedUp) {
  ScriptedDevice device;
  Exchange exchange;
  HapticLoop loop({.starts_armed = true}, device,
                  {exchange.commands, exchange.telemetry, exchange.stop});
  RealtimeThread thread(kModest);
  thread.start(loop);
  while (thread.timing().num_ticks() < 50) std::this_thread::yield();
  thread.stop();
  EXPECT_GT(thread.use().cpu_time_s, 0.0);
  EXPECT_GE(thread.use().num_page_faults, 0);
}

TEST(RealtimeThread, EndsCleanlyWithoutEverHavingBeenStarted) {
  RealtimeThread thread(kModest);
  thread.stop();
  EXPECT_EQ(thread.timing().num_ticks(), 0);
}

TEST(RealtimeThread, MayGoWithoutEverHavingBeenStartedOrStopped) {
  const RealtimeThread thread(kModest);
  EXPECT_EQ(thread.use().cpu_time_s, 0.0);
}

TEST(RealtimeThread, StoppedBeforeItsStartItNeverTicks) {
  ScriptedDevice device;
  Exchange exchange;
  HapticLoop loop({.starts_armed = true}, device,
                  {exchange.commands, exchange.telemetry, exchange.stop});
  RealtimeThread thread(kModest);
  thread.stop();
  thread.start(loop);
  thread.stop();
  EXPECT_TRUE(device.received.empty());
}

TEST(RealtimeThread, ATickThatTakesTooLongIsCountedAsMissedTicks) {
  ScriptedDevice device;
  FaultInjectingDevice stalling(
      device, {{.first_tick = 5, .injection = Injection::kStall, .magnitude = 0.025}});
  Exchange exchange;
  HapticLoop loop({.starts_armed = true}, stalling,
                  {exchange.commands, exchange.telemetry, exchange.stop});
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
  Exchange exchange;
  HapticLoop loop({.starts_armed = true, .rate_hz = 20'000.0}, hand,
                  {exchange.commands, exchange.telemetry, exchange.stop});
  hand.open();
  RealtimeThread thread(kModest);
  thread.start(loop);
  exchange.commands.publish({.sequence = 1, .medium = core::water({})});
  hand.simulated_hand()->begin_strokes(
      {.amplitude_m = 0.01, .max_speed_m_per_s = 1.0, .num_strokes = 1},
      core::RandomStream(1, "stroke"));
  while (hand.simulated_hand()->strokes_finished() < 1) {
    exchange.telemetry.fetch();
    std::this_thread::yield();
  }
  thread.stop();
  EXPECT_EQ(hand.simulated_hand()->strokes_finished(), 1);
  EXPECT_EQ(exchange.telemetry.value().fault, core::Fault::kNone);
}

TEST(RealtimeThread, NamesTheParameterItRejects) {
  EXPECT_THROW(RealtimeThread({.priority = 100}), core::Error);
  EXPECT_THROW(RealtimeThread({.cpu = -2}), core::Error);
  EXPECT_THROW(RealtimeThread({.max_spin_s = -1.0}), core::Error);
  EXPECT_THROW(RealtimeThread({.max_spin_s = std::nan("")}), core::Error);
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
  EXPECT_NO_THROW(require_realtime(device, full, false, &full));
  EXPECT_THROW(require_realtime(device, full, false, &nothing), core::Error)
      << "a watchdog that may come too late";
  EXPECT_NO_THROW(require_realtime(device, full, true, &nothing));
  device.device_capabilities.simulated = true;
  EXPECT_NO_THROW(require_realtime(device, nothing, false));
}

TEST(StartHaptics, ADeviceThatDoesNotStartIsToldAndNothingTicks) {
  ScriptedDevice inner;
  inner.device_capabilities.simulated = true;
  FaultInjectingDevice device(inner, {{.injection = Injection::kOpenFailure}});
  Exchange exchange;
  HapticLoop loop({.starts_armed = true}, device,
                  {exchange.commands, exchange.telemetry, exchange.stop});
  {
    RealtimeThread thread(kModest);
    try {
      start_haptics(device, loop, thread, false);
      FAIL() << "it has not been told";
    } catch (const core::Error& error) {
      EXPECT_EQ(std::string(error.what()).find("scripted: expected the device to start"), 0U)
          << error.what();
    }
    EXPECT_EQ(inner.num_closed, 1) << "it may have come half way";
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
    EXPECT_EQ(thread.timing().num_ticks(), 0);
  }
  EXPECT_EQ(inner.num_opened, 0);
  EXPECT_TRUE(inner.received.empty());

  RealtimeThread second(kModest);
  EXPECT_NO_THROW(start_haptics(device, loop, second, false)) << "at the second attempt";
  while (second.timing().num_ticks() < 3) std::this_thread::yield();
  second.stop();
  EXPECT_EQ(inner.num_opened, 1);
}

TEST(StartHaptics, WithoutRealTimeTheMotorsOfARealDeviceStayOff) {
  ScriptedDevice device;
  Exchange exchange;
  HapticLoop loop({.starts_armed = true}, device,
                  {exchange.commands, exchange.telemetry, exchange.stop});
  RealtimeThread thread(kModest);
  EXPECT_THROW(start_haptics(device, loop, thread, false), core::Error);
  EXPECT_EQ(device.num_opened, 0);
  EXPECT_EQ(thread.timing().num_ticks(), 0);
}

}  // namespace realtime_thread_test
}  // namespace jnd::device
