#include "app/commissioning/guided_run.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <thread>

#include "app/commissioning/device_on_bench.h"
#include "app/commissioning/measuring_steps.h"
#include "core/error.h"
#include "core/safety/emergency_stop.h"
#include "device/twin/twin_device.h"

namespace jnd::app {
namespace guided_run_test {

/// A twin with a clock of its own, so that it is measured in real time and watched.
class TimedTwin final : public device::HapticDevice {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return twin_.name(); }
  [[nodiscard]] device::DeviceCapabilities capabilities() const noexcept override {
    device::DeviceCapabilities can = twin_.capabilities();
    can.has_own_clock = true;
    return can;
  }
  void open() override { twin_.open(); }
  [[nodiscard]] bool read(core::HapticState& state) noexcept override {
    return twin_.read(state);
  }
  [[nodiscard]] bool write(const core::PointVectors& force_on_hand_n) noexcept override {
    return twin_.write(force_on_hand_n);
  }
  void close() noexcept override { twin_.close(); }
  void halt() noexcept override { twin_.halt(); }
  [[nodiscard]] device::Bench* bench() noexcept override { return twin_.bench(); }

 private:
  device::TwinDevice twin_{{.friction_n = 0.5, .position_sd_m = 1e-5}};
};

/// Imitates a person who takes longer for every request than a window may be silent.
class SlowBench final : public device::Bench {
 public:
  explicit SlowBench(device::Bench& bench) : bench_(bench) {}
  void take_hand_out() override {
    slowly([this] { bench_.take_hand_out(); });
  }
  void home() override {
    slowly([this] { bench_.home(); });
  }
  void let_go_without_force() override {
    slowly([this] { bench_.let_go_without_force(); });
  }
  void clamp() override {
    slowly([this] { bench_.clamp(); });
  }
  void touch(const Eigen::Vector3d& mark_m) override {
    slowly([&] { bench_.touch(mark_m); });
  }
  void let_go() override {
    slowly([this] { bench_.let_go(); });
  }
  void hang(double load_kg) override {
    slowly([&] { bench_.hang(load_kg); });
  }

 private:
  template <typename Act>
  static void slowly(const Act& act) {
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    act();
  }
  device::Bench& bench_;
};

const device::MotionGuide::Order kHold = {.to_m = {0.0, 0.0, -0.1},
                                          .stiffness_n_per_m = 40.0,
                                          .damping_n_s_per_m = 3.0,
                                          .is_on = true};

double most_n(GuidedRun& run, double duration_s) {
  double most_n = 0.0;
  run.run_for(duration_s, [&](const core::Sample& sample) {
    for (const core::PlainVector& force_n : sample.tip_force_n) {
      for (const double component : force_n) most_n = std::max(most_n, std::abs(component));
    }
  });
  return most_n;
}

TEST(GuidedRun, WhoIsAskedMayTakeTheirTime) {
  TimedTwin twin;
  SlowBench bench(*twin.bench());
  const MeasuringPlan plan{.allow_no_realtime = true};
  const analysis::NoiseFit noise =
      measure_noise(twin, bench, plan, [](double, const std::string&) {});
  EXPECT_TRUE(noise.position_sd_m.holds(1e-5)) << noise.position_sd_m.value;
}

TEST(GuidedRun, TheForceStandsWhileSomebodyIsAskedAndIsGoneWhereTheyAct) {
  TimedTwin twin;
  GuidedRun run(twin, {.allow_no_realtime = true});
  run.arm();
  run.order(kHold);
  EXPECT_GT(most_n(run, 0.1), 0.05) << "it is held away from where it was";
  run.while_asking([] { std::this_thread::sleep_for(std::chrono::milliseconds(600)); });
  EXPECT_NO_THROW(run.run_for(0.1)) << "no heartbeat was lost";
  run.without_force([] { std::this_thread::sleep_for(std::chrono::milliseconds(600)); });
  EXPECT_EQ(most_n(run, 0.1), 0.0) << "none comes by itself";
  run.arm();
  EXPECT_GT(most_n(run, 0.1), 0.05);
}

TEST(GuidedRun, TheForceEndsWhileTheWindowThatHasTheStopIsSilent) {
  TimedTwin twin;
  core::Heartbeat window;
  std::atomic<bool> is_alive = true;
  const std::jthread drawing([&](const std::stop_token& ends) {
    while (!ends.stop_requested()) {
      if (is_alive) window.beat();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
  GuidedRun run(twin, {.allow_no_realtime = true, .watcher = &window});
  run.arm();
  run.order(kHold);
  EXPECT_NO_THROW(run.run_for(0.6));
  run.while_asking([] { std::this_thread::sleep_for(std::chrono::milliseconds(600)); });
  EXPECT_NO_THROW(run.run_for(0.1)) << "also while somebody is asked";
  is_alive = false;
  EXPECT_THROW(run.run_for(1.0), core::Error);
}

TEST(GuidedRun, AnEmergencyStopEndsItAndNothingArmsItMeanwhile) {
  TimedTwin twin;
  core::EmergencyStop stop;
  GuidedRun run(twin, {.allow_no_realtime = true, .emergency_stop = &stop});
  run.arm();
  run.order(kHold);
  stop.press();
  EXPECT_THROW(run.run_for(0.2), core::Error);
  EXPECT_THROW(run.arm(), core::Error);
}

/// Somebody who does something else than they were asked to.
class OddBench final : public device::Bench {
 public:
  explicit OddBench(device::Bench& bench) : bench_(bench) {}
  void take_hand_out() override { bench_.take_hand_out(); }
  void home() override { bench_.home(); }
  void let_go_without_force() override { bench_.let_go_without_force(); }
  void clamp() override { bench_.clamp(); }
  void expect_force() override {
    ++num_told;
    if (instead) instead();
  }
  void touch(const Eigen::Vector3d& mark_m) override { bench_.touch(mark_m); }
  void let_go() override { bench_.let_go(); }
  void hang(double load_kg) override { bench_.hang(load_kg); }

  int num_told = 0;
  std::function<void()> instead;

 private:
  device::Bench& bench_;
};

TEST(DeviceOnBench, WhoHoldsTheToolIsToldBeforeAForceGrows) {
  device::TwinDevice twin({});
  OddBench bench(*twin.bench());
  DeviceOnBench started(twin, bench, {});
  started.hold(kSoftHold);
  EXPECT_EQ(bench.num_told, 1);
  started.act([] {});
  EXPECT_EQ(bench.num_told, 2);
}

TEST(DeviceOnBench, HoldsAToolFromWhereSomebodyHasBroughtIt) {
  device::TwinDevice twin({});
  OddBench bench(*twin.bench());
  DeviceOnBench started(twin, bench, {});
  started.hold(kSoftHold);
  const Eigen::Vector3d before_m = started.place_m();
  const Eigen::Vector3d aside_m(0.1, 0.0, 0.0);
  started.act([&] {
    bench.touch(before_m + aside_m);
    // The hand carries the tool at 0.3 m/s, and `place_m` takes 0.02 s.
    for (int i = 0; i < 20; ++i) (void)started.place_m();
  });
  EXPECT_GT((started.place_m() - before_m).norm(), 0.07) << "it was pulled back";
}

TEST(DeviceOnBench, AForceThatMovesWhatSomebodyHoldsEnds) {
  device::TwinDevice twin({});
  OddBench bench(*twin.bench());
  DeviceOnBench started(twin, bench, {});
  started.hold(kSoftHold);
  bench.instead = [&bench] {
    bench.let_go();
    bench.hang(2.0);
  };
  EXPECT_THROW(started.act([] {}), core::Error);
}

/// While somebody was busy at the tool, there was no force, and the window may have hung.
TEST(DeviceOnBench, AFaultWhileThereWasNoForceIsForArmingToJudge) {
  TimedTwin twin;
  OddBench bench(*twin.bench());
  core::Heartbeat window;
  std::atomic<bool> is_alive = true;
  const std::jthread drawing([&](const std::stop_token& ends) {
    while (!ends.stop_requested()) {
      if (is_alive) window.beat();
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
  DeviceOnBench started(twin, bench, {.allow_no_realtime = true, .watcher = &window});
  started.hold(kSoftHold);
  core::Fault meanwhile = core::Fault::kNone;
  EXPECT_NO_THROW(started.act([&] {
    is_alive = false;
    std::this_thread::sleep_for(std::chrono::milliseconds(600));
    meanwhile = started.run().telemetry().fault;
    is_alive = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }));
  EXPECT_EQ(meanwhile, core::Fault::kHeartbeatLost);
  EXPECT_EQ(started.run().telemetry().fault, core::Fault::kNone) << "it is held again";
}

TEST(DeviceOnBench, AStopWhileThereWasNoForceStaysOne) {
  device::TwinDevice twin({});
  OddBench bench(*twin.bench());
  core::EmergencyStop stop;
  DeviceOnBench started(twin, bench, {.emergency_stop = &stop});
  started.hold(kSoftHold);
  EXPECT_THROW(started.act([&] { stop.press(); }), core::Error);
}

TEST(GuidedRun, AGuideGetsNoMoreThanTheLimits) {
  device::TwinDevice twin({});
  GuidedRun run(twin, {.limits = {.per_point_n = 1.0, .total_n = 2.0}});
  twin.bench()->take_hand_out();
  twin.bench()->clamp();
  run.arm();
  device::MotionGuide::Order strong = kHold;
  strong.to_m = {1.0, 0.0, 0.0};
  strong.speed_m_per_s = 5.0;
  strong.stiffness_n_per_m = 1000.0;
  run.order(strong);
  double most_n = 0.0, most_total_n = 0.0;
  run.run_for(1.0, [&](const core::Sample& sample) {
    double total_n = 0.0;
    for (const core::PlainVector& f : sample.tip_force_n) {
      const double size_n = std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
      most_n = std::max(most_n, size_n);
      total_n += size_n;
    }
    most_total_n = std::max(most_total_n, total_n);
  });
  EXPECT_GT(most_total_n, 1.9);
  EXPECT_LE(most_n, 1.0 + 1e-9);
  EXPECT_LE(most_total_n, 2.0 + 1e-9);
}

}  // namespace guided_run_test
}  // namespace jnd::app
