#include "app/session/apparatus.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <functional>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "core/error.h"
#include "core/media/medium.h"
#include "core/random_stream.h"
#include "experiments/participants/thesis_laboratory.h"
#include "support/wide_profile.h"

namespace jnd::app {
namespace apparatus_test {

double force_n(const Apparatus& apparatus) {
  const core::PlainVector& force = apparatus.telemetry().total_force_n;
  return std::hypot(force[0], force[1], force[2]);
}

/// Imitates a window by its exchange with the session alone.
class ApparatusTest : public ::testing::Test {
 protected:
  [[nodiscard]] Apparatus::Parameters with_doors(const std::string& device, bool realtime) {
    Apparatus::Parameters parameters;
    parameters.device = device;
    parameters.realtime = realtime;
    parameters.allow_no_realtime = true;
    parameters.exchange = &exchange_;
    return parameters;
  }

  void point_at(double x_m) {
    ++pointer_.sequence;
    pointer_.x_m = x_m;
    exchange_.pointer.publish(pointer_);
  }

  /// Waits until `is_so`, and sends heartbeats meanwhile if the window lives. Returns false if
  /// it takes longer than 20 s.
  [[nodiscard]] bool wait_until(const std::function<bool()>& is_so, bool window_lives) {
    const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (std::chrono::steady_clock::now() < patience) {
      if (window_lives) exchange_.heartbeat.beat();
      if (is_so()) return true;
      std::this_thread::yield();
    }
    return false;
  }

  /// Returns whether there is force. If the machine was so busy that the heartbeat came too
  /// late, the force is gone, so this arms the device again first.
  [[nodiscard]] bool feels_force(Apparatus& apparatus) {
    if (apparatus.telemetry().fault == core::Fault::kHeartbeatLost) apparatus.rearm();
    return force_n(apparatus) > 1.0;
  }

  experiments::Laboratory laboratory_ = experiments::thesis_laboratory();
  OperatorExchange exchange_;
  core::PointerPosition pointer_;
};

TEST_F(ApparatusTest, AMouseNeedsNoLaboratoryAndFollowsThePointerOfTheDoors) {
  Apparatus apparatus(with_doors("mouse", /*realtime=*/false));
  point_at(0.2);
  apparatus.run_for(1.0);
  EXPECT_NEAR(apparatus.telemetry().hand_position_m[0], 0.2, 1e-6);
  EXPECT_NEAR(apparatus.telemetry().hand_position_m[2], -0.15, 1e-12);
}

TEST_F(ApparatusTest, AHandThatAPersonMovesTakesNoOrdersForStrokes) {
  Apparatus apparatus(with_doors("mouse", /*realtime=*/false));
  apparatus.begin_strokes({.num_strokes = 1}, core::RandomStream(1, "stroke"));
  apparatus.run_for(3.0);
  EXPECT_EQ(apparatus.strokes_finished(), 0);
  EXPECT_EQ(apparatus.telemetry().hand_position_m[0], 0.0);
  apparatus.go_home();
  apparatus.run_for(0.1);
  EXPECT_EQ(apparatus.telemetry().hand_position_m[0], 0.0);
}

TEST_F(ApparatusTest, AMouseWorksWithoutAWindowToo) {
  Apparatus::Parameters parameters;
  parameters.device = "mouse";
  Apparatus apparatus(parameters);
  apparatus.run_for(0.1);
  EXPECT_EQ(apparatus.telemetry().fault, core::Fault::kNone);
}

TEST_F(ApparatusTest, AnUnknownDeviceIsRefused) {
  EXPECT_THROW(Apparatus(with_doors("phantom", false)), core::Error);
  EXPECT_THROW(Apparatus(with_doors("phantom", false), laboratory_), core::Error);
}

TEST_F(ApparatusTest, TheTotalForceIsTheLeastOfLaboratoryAndDevice) {
  EXPECT_EQ(Apparatus(with_doors("mouse", false)).max_total_force_n(), 30.0);
  laboratory_.device.max_total_force_n = 12.0;
  EXPECT_EQ(Apparatus(with_doors("lumped", false), laboratory_).max_total_force_n(), 12.0);
  EXPECT_EQ(Apparatus(with_doors("mouse", false), laboratory_).max_total_force_n(), 12.0);
  laboratory_.device.max_total_force_n = 100.0;
  EXPECT_EQ(Apparatus(with_doors("mouse", false), laboratory_).max_total_force_n(), 30.0);
  EXPECT_EQ(Apparatus(with_doors("lumped", false), laboratory_).max_total_force_n(), 30.0)
      << "a laboratory may ask for less alone";
}

std::shared_ptr<const KnownProfile> profile_of(const std::string& model,
                                               const std::string& serial = "") {
  return std::make_shared<const KnownProfile>(
      KnownProfile{.profile = test_support::wide_profile(model, serial), .place = "a profile"});
}

TEST_F(ApparatusTest, AProfileMovesTheHandIntoTheWorkspaceAndNarrowsTheForce) {
  Apparatus::Parameters parameters = with_doors("mouse", /*realtime=*/false);
  KnownProfile known = *profile_of("mouse");
  known.profile.frame.rotation = {0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0};
  known.profile.frame.offset_m = {0.0, 0.0, 0.05};
  known.profile.limits.max_total_force_n = 4.0;
  known.profile.mechanics.mass_kg = experiments::MeasuredValue{0.7, {0.6, 0.8}};
  parameters.profile = std::make_shared<const KnownProfile>(known);
  Apparatus apparatus(parameters);
  point_at(0.2);
  apparatus.run_for(1.0);
  EXPECT_NEAR(apparatus.telemetry().hand_position_m[0], 0.0, 1e-6);
  EXPECT_NEAR(apparatus.telemetry().hand_position_m[1], 0.2, 1e-6);
  EXPECT_NEAR(apparatus.telemetry().hand_position_m[2], -0.10, 1e-12);
  EXPECT_EQ(apparatus.max_total_force_n(), 4.0);
  EXPECT_EQ(apparatus.device_told().own_mass_kg, 0.0) << "what it says itself is kept";
}

TEST_F(ApparatusTest, ADeviceThatIsNotTheOneOfTheProfileIsRefusedOnceItIsOpen) {
  for (const auto& [model, serial] : {std::pair("lumped", "9"), std::pair("omega", "")}) {
    Apparatus::Parameters parameters = with_doors("lumped", /*realtime=*/false);
    parameters.profile = profile_of(model, serial);
    EXPECT_THROW(Apparatus(parameters, laboratory_), core::Error) << model;
  }
  Apparatus::Parameters parameters = with_doors("lumped", /*realtime=*/false);
  parameters.profile = profile_of("lumped");
  EXPECT_NO_THROW(Apparatus(parameters, laboratory_));
}

TEST_F(ApparatusTest, TheWindowsStopLatchesAndRearmingBringsTheForceBack) {
  Apparatus apparatus(with_doors("lumped", /*realtime=*/false), laboratory_);
  apparatus.render(core::viscous({.viscosity_pa_s = 8.0}));
  apparatus.begin_strokes({}, core::RandomStream(1, "stroke"));
  apparatus.run_for(0.4);
  EXPECT_GT(force_n(apparatus), 1.0);
  exchange_.emergency_stop.press();
  EXPECT_THROW(apparatus.run_for(0.1), core::Error);
  EXPECT_EQ(apparatus.telemetry().fault, core::Fault::kEmergencyStop);
  EXPECT_EQ(force_n(apparatus), 0.0);
  (void)exchange_.emergency_stop.release(exchange_.emergency_stop.num_presses());
  EXPECT_THROW(apparatus.run_for(0.1), core::Error) << "latched";
  exchange_.emergency_stop.press();
  apparatus.rearm();
  EXPECT_THROW(apparatus.run_for(0.1), core::Error) << "still pressed";
  (void)exchange_.emergency_stop.release(exchange_.emergency_stop.num_presses());
  apparatus.rearm();
  double most_n = 0.0;
  for (int glance = 0; glance < 100; ++glance) {
    apparatus.run_for(0.02);
    most_n = std::max(most_n, force_n(apparatus));
  }
  EXPECT_EQ(apparatus.telemetry().fault, core::Fault::kNone);
  EXPECT_EQ(apparatus.telemetry().authority_ratio, 1.0);
  EXPECT_GT(most_n, 1.0);
}

TEST_F(ApparatusTest, InRealTimeAWindowThatFallsSilentFadesTheForceUntilItIsRearmed) {
  Apparatus apparatus(with_doors("lumped", /*realtime=*/true), laboratory_);
  apparatus.render(core::viscous({.viscosity_pa_s = 8.0}));
  apparatus.begin_strokes({}, core::RandomStream(1, "stroke"));
  ASSERT_TRUE(wait_until([&] { return feels_force(apparatus); }, /*window_lives=*/true));
  // The program sends no heartbeat either while it waits for the disk.
  const std::uint64_t beats = exchange_.heartbeat.count();
  apparatus.meter_strokes();
  (void)apparatus.finish_strokes();
  try {
    apparatus.run_for(0.05);
  } catch (const core::Error&) {
    // On a machine this slow, the silence has exceeded its limit already.
  }
  EXPECT_EQ(exchange_.heartbeat.count(), beats);

  ASSERT_TRUE(wait_until(
      [&] { return apparatus.telemetry().fault == core::Fault::kHeartbeatLost; }, false));
  ASSERT_TRUE(wait_until([&] { return apparatus.telemetry().authority_ratio == 0.0; }, false));
  EXPECT_EQ(force_n(apparatus), 0.0);
  // A window that comes back does not bring back the force. Only a person does.
  const std::int64_t tick = apparatus.next_tick();
  ASSERT_TRUE(wait_until([&] { return apparatus.next_tick() > tick + 20; }, true));
  EXPECT_EQ(apparatus.telemetry().fault, core::Fault::kHeartbeatLost);
  apparatus.rearm();
  EXPECT_TRUE(wait_until([&] { return feels_force(apparatus); }, true));
}

TEST_F(ApparatusTest, InRealTimeTheWindowsStopIsThere) {
  Apparatus apparatus(with_doors("mouse", /*realtime=*/true));
  apparatus.render(core::viscous({.viscosity_pa_s = 8.0}));
  double goal_m = 0.3;
  const auto moves_against_force = [&] {
    if (std::abs(apparatus.telemetry().hand_position_m[0] - goal_m) < 0.1) goal_m = -goal_m;
    point_at(goal_m);
    return feels_force(apparatus);
  };
  ASSERT_TRUE(wait_until(moves_against_force, true));
  exchange_.emergency_stop.press();
  ASSERT_TRUE(wait_until(
      [&] { return apparatus.telemetry().fault == core::Fault::kEmergencyStop; }, true));
  EXPECT_EQ(force_n(apparatus), 0.0);
  (void)exchange_.emergency_stop.release(exchange_.emergency_stop.num_presses());
  apparatus.rearm();
  EXPECT_TRUE(wait_until(moves_against_force, true));
}

TEST_F(ApparatusTest, ALoopThatStandsStillIsToldByItsWatchdog) {
  Apparatus::Parameters parameters = with_doors("lumped", /*realtime=*/true);
  parameters.injected_faults = {
      {.first_tick = 50, .injection = device::Injection::kStall, .magnitude = 1.5}};
  Apparatus apparatus(parameters, laboratory_);
  ASSERT_TRUE(
      wait_until([&] { return apparatus.telemetry().fault == core::Fault::kWatchdog; }, true));
  EXPECT_LE(apparatus.telemetry().num_ticks, 51) << "told while it stood still, not after";
  const std::uint64_t num_faults = apparatus.telemetry().num_faults;
  ASSERT_TRUE(wait_until([&] { return apparatus.telemetry().num_ticks > 60; }, true));
  EXPECT_EQ(apparatus.telemetry().fault, core::Fault::kWatchdog);
  EXPECT_EQ(apparatus.telemetry().num_faults, num_faults) << "one fault, told once";
  EXPECT_THROW(apparatus.run_for(0.01), core::Error);
}

TEST_F(ApparatusTest, InRealTimeWithoutAWindowItKeepsItselfAlive) {
  Apparatus::Parameters parameters;
  parameters.realtime = true;
  Apparatus apparatus(parameters, laboratory_);
  EXPECT_NO_THROW(apparatus.run_for(0.4)) << "longer than a heartbeat may be silent";
}

TEST_F(ApparatusTest, EverySampleIsSeenOnceAndInOrder) {
  for (const bool realtime : {false, true}) {
    std::int64_t num_samples = 0, num_missed = 0;
    bool in_order = true;
    std::atomic<std::thread::id> seen_by;
    Apparatus::Parameters parameters;
    parameters.realtime = realtime;
    parameters.first_tick = 70;
    parameters.on_sample = [&](const core::Sample& sample) {
      ++num_samples;
      num_missed += sample.num_missed_before;
      in_order &= sample.tick == 69 + num_samples + num_missed;
      seen_by = std::this_thread::get_id();
    };
    {
      Apparatus apparatus(parameters, laboratory_);
      apparatus.run_for(0.3);
    }
    EXPECT_TRUE(in_order);
    EXPECT_GE(num_samples + num_missed, 300);
    if (!realtime) {
      EXPECT_EQ(num_samples, 300);
    }
    EXPECT_EQ(seen_by.load() == std::this_thread::get_id(), !realtime);
  }
}

TEST_F(ApparatusTest, StrokesAreCountedWhileTheyHappen) {
  Apparatus apparatus(with_doors("lumped", /*realtime=*/false), laboratory_);
  apparatus.begin_strokes({.amplitude_m = 0.1, .num_strokes = 5},
                          core::RandomStream(1, "stroke"));
  apparatus.run_for(0.5);
  EXPECT_EQ(apparatus.num_metered_strokes(), 0) << "none are metered yet";
  apparatus.meter_strokes();
  int last = 0;
  int num_rises = 0;
  for (int glance = 0; glance < 600; ++glance) {
    apparatus.run_for(0.02);
    num_rises += apparatus.num_metered_strokes() == last + 1 ? 1 : 0;
    last = apparatus.num_metered_strokes();
  }
  EXPECT_GE(last, 3);
  EXPECT_EQ(num_rises, last) << "one by one";
  EXPECT_EQ(apparatus.finish_strokes().num_strokes, last);
  EXPECT_EQ(apparatus.num_metered_strokes(), 0);
}

TEST_F(ApparatusTest, WatchingSimulatedStrokesChangesNone) {
  const auto run = [&](bool watched) {
    Apparatus::Parameters parameters;
    if (watched) {
      parameters = with_doors("lumped", false);
      parameters.on_sample = [](const core::Sample&) {};
    }
    Apparatus apparatus(parameters, laboratory_);
    apparatus.render(core::water({.scale = 2.0}));
    apparatus.begin_strokes({}, core::RandomStream(1, "stroke"));
    apparatus.run_for(3.0);
    return apparatus.telemetry().hand_position_m;
  };
  EXPECT_EQ(run(false), run(true));
}

}  // namespace apparatus_test
}  // namespace jnd::app
