#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "device/fault_injection.h"
#include "device/haptic_loop.h"
#include "device/lumped_hand_device.h"
#include "device/mouse_device.h"
#include "device/realtime_thread.h"
#include "realtime_trap.h"
#include "scripted_device.h"
#include "support/allocation_counter.h"

namespace jnd::device {
namespace realtime_tick_test {

using test_support::AllocationCounter;
using test_support::LockCounter;
using test_support::LockedMemory;
using test_support::PageFaultCounter;
using test_support::SystemCallTrap;

constexpr int kNumTicks = 5'000;
constexpr const char* kSanitizer = "a sanitizer has these functions for itself";

core::MediumAmounts everything() {
  return core::solid({.stiffness_n_per_m = 100.0, .friction_ratio = 0.5}) +
         core::container({.stiffness_n_per_m = 100.0, .friction_ratio = 0.5}) +
         core::water({}) + core::mapped_water({}) +
         core::viscous_inertial({.viscosity_pa_s = 10.0}) +
         core::ellipsoid({.viscosity_pa_s = 10.0}) + core::buoyant(3.0);
}

const core::ForceMap& some_map() {
  static const core::ForceMap map(
      {{0.0, 1.0, 0.2, 0.0}, {0.8, 1.0, 0.6, 0.5}, {1.571, 1.0, 0.9, 0.0}});
  return map;
}

enum class Which { kScripted, kLumped, kMouse };

/// A loop with everything that it exchanges, and a device in which faults may happen.
struct Scene {
  Scene(std::vector<ScheduledFault> faults, Which which, std::size_t queue_capacity)
      : samples(queue_capacity),
        faulty(device(which), std::move(faults)),
        loop({.starts_armed = true,
              .workspace = {.half_width_x_m = 100.0},
              .force_map = &some_map()},
             faulty, {commands, telemetry, stop, &samples, &heartbeat}) {
    // The memory of the test's own device is allocated before the ticks.
    scripted.received.resize(kNumTicks);
    scripted.received.clear();
    scripted.move_all({0.05, 0.0, 0.0});
    faulty.open();
    hand.simulated_hand()->begin_strokes({}, core::RandomStream(1, "stroke"));
  }

  HapticDevice& device(Which which) {
    switch (which) {
      case Which::kLumped:
        return hand;
      case Which::kMouse:
        return mouse;
      case Which::kScripted:
        break;
    }
    return scripted;
  }

  void command(const core::MediumAmounts& medium) {
    commands.publish({.sequence = ++sequence, .medium = medium, .ramp_s = 0.050});
  }
  /// Runs the loop with a window that lives and a consumer that keeps up.
  void run(int num_ticks) {
    for (int i = 0; i < num_ticks; ++i) {
      heartbeat.beat();
      if (i % 16 == 0) {
        pointer.x_m = ++pointer.sequence % 40 < 20 ? 0.2 : -0.2;
        mouse.pointer().publish(pointer);
      }
      loop.tick();
      if (drains) samples.drain([](const core::Sample&) {});
    }
  }

  /// As somebody who has seen all that is latched.
  void arm() {
    telemetry.fetch();
    loop.rearm(telemetry.value().num_faults);
  }

  LumpedHandDevice hand{LumpedHandDevice::Parameters{.dry_friction_n = 0.3}};
  ScriptedDevice scripted;
  MouseDevice mouse{MouseDevice::Parameters{}};
  core::PointerPosition pointer;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  core::Heartbeat heartbeat;
  core::SpscQueue<core::Sample> samples;
  bool drains = true;
  FaultInjectingDevice faulty;
  HapticLoop loop;
  std::uint64_t sequence = 0;
};

struct Situation {
  const char* name;
  std::vector<ScheduledFault> faults;
  void (*play)(Scene& scene);
  core::Fault expected;  ///< The fault at the end.
};

/// Strikes from tick 100 on, and arms again at tick 400.
void be_struck_and_rearm(Scene& scene) {
  scene.command(core::viscous({.viscosity_pa_s = 10.0}));
  scene.run(400);
  scene.arm();
  scene.run(kNumTicks - 400);
}

template <core::MediumAmounts (*kMedium)()>
void stay_in(Scene& scene) {
  scene.command(kMedium());
  scene.run(kNumTicks);
}

core::MediumAmounts some_water() { return core::water({}); }
core::MediumAmounts some_honey() { return core::viscous({.viscosity_pa_s = 10.0}); }
core::MediumAmounts some_wall() { return core::solid({.stiffness_n_per_m = 500.0}); }

const std::vector<Situation>& situations() {
  using core::Fault;
  static const std::vector<Situation> all = {
      {"FreeSpace", {}, stay_in<core::free_space>, Fault::kNone},
      {"Water", {}, stay_in<some_water>, Fault::kNone},
      {"Viscous", {}, stay_in<some_honey>, Fault::kNone},
      {"Solid", {}, stay_in<some_wall>, Fault::kNone},
      {"AllAtOnce", {}, stay_in<everything>, Fault::kNone},
      {"Limited",
       {},
       [](Scene& scene) {
         scene.command(core::viscous({.viscosity_pa_s = 30.0}));
         scene.scripted.move_all({1.0, 0.0, 0.0});
         scene.run(kNumTicks);
       },
       Fault::kNone},
      {"ManyCommands",
       {},
       [](Scene& scene) {
         for (int i = 0; i < kNumTicks; i += 20) {
           scene.command(i % 40 == 0 ? everything() : core::free_space());
           scene.run(20);
         }
       },
       Fault::kNone},
      {"FullQueue",
       {},
       [](Scene& scene) {
         scene.drains = false;
         stay_in<some_water>(scene);
       },
       Fault::kNone},
      {"EmergencyStop",
       {},
       [](Scene& scene) {
         scene.command(everything());
         scene.run(100);
         scene.stop.press();
         scene.run(100);
         (void)scene.stop.release(scene.stop.num_presses());
         scene.run(510);
         scene.arm();
         scene.run(490);
         scene.stop.press();
         scene.run(kNumTicks - 1200);
       },
       Fault::kEmergencyStop},
      {"SilentWindow",
       {},
       [](Scene& scene) {
         scene.command(everything());
         scene.run(100);
         scene.drains = false;
         for (int i = 0; i < kNumTicks - 100; ++i) scene.loop.tick();
       },
       Fault::kHeartbeatLost},
      {"CommandThatIsNoNumber",
       {},
       [](Scene& scene) {
         scene.command({.damping_n_s_per_m = std::numeric_limits<double>::quiet_NaN()});
         scene.run(kNumTicks);
       },
       Fault::kNonFiniteForce},
      {"NonFinitePosition",
       {{100, 5, Injection::kNonFinitePosition}},
       be_struck_and_rearm,
       Fault::kNone},
      {"NonFiniteVelocity",
       {{100, 5, Injection::kNonFiniteVelocity}},
       be_struck_and_rearm,
       Fault::kNone},
      {"ReadFailure", {{100, 5, Injection::kReadFailure}}, be_struck_and_rearm, Fault::kNone},
      {"WriteFailure", {{100, 5, Injection::kWriteFailure}}, be_struck_and_rearm, Fault::kNone},
      {"FrozenSample",
       {{100, 50, Injection::kFrozenSample}},
       be_struck_and_rearm,
       Fault::kNone},
      {"StaleTime", {{100, 50, Injection::kStaleTime}}, be_struck_and_rearm, Fault::kNone},
      {"DetachedPoint",
       {{100, 50, Injection::kDetachedPoint}},
       be_struck_and_rearm,
       Fault::kNone},
      {"PositionJump",
       {{100, 50, Injection::kPositionJump, core::ContactPoint::kIndex, 0.05}},
       be_struck_and_rearm,
       Fault::kNone},
      {"VelocitySpike",
       {{100, 1, Injection::kVelocitySpike, core::ContactPoint::kThumb, 20.0}},
       be_struck_and_rearm,
       Fault::kNone},
      {"ForceSpike",
       {{100, 5, Injection::kForceSpike, core::ContactPoint::kThumb, 7.0}},
       be_struck_and_rearm,
       Fault::kNone},
      {"FaultThatLasts",
       {{100, kNumTicks, Injection::kReadFailure}},
       be_struck_and_rearm,
       Fault::kDeviceReadFailed},
  };
  return all;
}

/// Plays every situation on every device, after one round to warm up. A `Watch` watches each
/// from its first tick to its last. `caught` says what the watch has seen, if anything.
template <typename Watch, typename Caught>
void expect_nothing_in_any_situation(Caught&& caught) {
  for (const Situation& situation : situations()) {
    for (const Which which : {Which::kScripted, Which::kLumped, Which::kMouse}) {
      Scene rehearsal(situation.faults, which, 64);
      SCOPED_TRACE(std::string(situation.name) + ", " + std::string(rehearsal.faulty.name()));
      situation.play(rehearsal);
      Scene scene(situation.faults, which, 64);
      std::int64_t found = 0;
      {
        const Watch watch;
        situation.play(scene);
        found = caught(watch);
      }
      EXPECT_EQ(found, 0);
      scene.telemetry.fetch();
      EXPECT_EQ(scene.telemetry.value().fault, situation.expected);
      EXPECT_EQ(scene.telemetry.value().num_ticks, kNumTicks);
      EXPECT_EQ(scene.telemetry.value().num_dropped_samples > 0, !scene.drains);
    }
  }
}

TEST(RealtimeTick, NeitherAllocatesNorFrees) {
  if (!AllocationCounter::is_supported()) GTEST_SKIP() << kSanitizer;
  expect_nothing_in_any_situation<AllocationCounter>([](const AllocationCounter& counter) {
    return static_cast<std::int64_t>(counter.allocations() + counter.frees());
  });
}

TEST(RealtimeTick, TakesNoLock) {
  if (!LockCounter::is_supported()) GTEST_SKIP() << kSanitizer;
  expect_nothing_in_any_situation<LockCounter>(
      [](const LockCounter& counter) { return static_cast<std::int64_t>(counter.locks()); });
}

TEST(RealtimeTick, MissesNoPageOfMemory) {
  if (!PageFaultCounter::is_supported()) GTEST_SKIP() << kSanitizer;
  const LockedMemory memory;
  if (!memory.is_locked()) GTEST_SKIP() << "memory cannot be locked here: see `jnd doctor`";
  expect_nothing_in_any_situation<PageFaultCounter>(
      [](const PageFaultCounter& counter) { return counter.faults(); });
}

TEST(RealtimeTick, MakesNoSystemCall) {
  if (!SystemCallTrap::is_supported()) GTEST_SKIP() << "no dispatch of system calls here";
  expect_nothing_in_any_situation<SystemCallTrap>(
      [](const SystemCallTrap&) { return SystemCallTrap::first_call().value_or(0); });
}

/// Watches the thread that drives it, from its hundredth tick on.
class WatchingDevice final : public HapticDevice {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return hand_.name(); }
  [[nodiscard]] DeviceCapabilities capabilities() const noexcept override {
    return hand_.capabilities();
  }
  void open() override { hand_.open(); }
  [[nodiscard]] bool read(core::HapticState& state) noexcept override {
    if (++num_reads_ == 100) {
      allocations_.emplace();
      locks_.emplace();
      page_faults_.emplace();
    }
    return hand_.read(state);
  }
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
    if (locks_) {
      num_allocations = allocations_->allocations() + allocations_->frees();
      num_locks = locks_->locks();
      num_page_faults = page_faults_->faults();
    }
    return hand_.write(force_on_hand_n);
  }
  void close() noexcept override {}
  void halt() noexcept override {}

  std::size_t num_allocations = 0;
  std::size_t num_locks = 0;
  std::int64_t num_page_faults = 0;

 private:
  LumpedHandDevice hand_{LumpedHandDevice::Parameters{.rate_hz = 5000.0}};
  int num_reads_ = 0;
  std::optional<AllocationCounter> allocations_;
  std::optional<LockCounter> locks_;
  std::optional<PageFaultCounter> page_faults_;
};

TEST(RealtimeThread, BetweenTicksItNeitherAllocatesNorLocksNorMissesAPage) {
  if (!LockCounter::is_supported()) GTEST_SKIP() << kSanitizer;
  WatchingDevice device;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  HapticLoop loop({.starts_armed = true, .rate_hz = 5000.0}, device,
                  {commands, telemetry, stop});
  RealtimeThread thread({.priority = 0, .keep_cpus_awake = false});
  start_haptics(device, loop, thread, false);
  commands.publish({.sequence = 1, .medium = everything()});
  while (thread.timing().num_ticks() < 2000) std::this_thread::yield();
  thread.stop();
  EXPECT_EQ(device.num_allocations, 0U);
  EXPECT_EQ(device.num_locks, 0U);
  if (!thread.report().memory_locked) GTEST_SKIP() << "memory cannot be locked here";
  EXPECT_EQ(device.num_page_faults, 0);
}

}  // namespace realtime_tick_test
}  // namespace jnd::device
