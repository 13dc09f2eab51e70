#include <set>

#include "core/media/medium.h"
#include "device/haptic_loop.h"
#include "device/realtime_thread.h"
#include "plugin_fixture.h"

namespace jnd::device {
namespace pincer_plugin_test {

using core::Fault;

/// A device of two points that are not the first ones, with shares of its own. It measures
/// everything that can be measured, and sets the pace.
class PincerPluginTest : public PluginTest {
 protected:
  static std::string pincer(const std::string& options = "") {
    const auto source =
        test_support::source_folder() / "tests" / "device" / "plugin" / "pincer_driver.c";
    return built(source, "pincer").string() + ":simulated" + options;
  }
};

TEST_F(PincerPluginTest, WhatItTellsOfItselfIsWhatTheProgramKnows) {
  const auto device = opened(pincer());
  const DeviceCapabilities can = device->capabilities();
  EXPECT_EQ(can.share_ratio, (core::ShareRatios{0.0, 0.0, 0.25, 0.75, 0.0}));
  EXPECT_EQ(can.num_contact_points(), 2);
  EXPECT_FALSE(can.has_point(0));
  EXPECT_EQ(can.channels, core::kAllChannels);
  EXPECT_EQ(can.own_mass_kg, 0.3);
  EXPECT_EQ(can.own_damping_n_s_per_m, 1.5);
  EXPECT_EQ(can.closed_loop_delay_s, 0.001);
  EXPECT_TRUE(can.paces_loop);
  EXPECT_EQ(device->identity().model, "pincer");
  EXPECT_EQ(device->identity().serial, "P-7");
}

TEST_F(PincerPluginTest, WhatItMeasuresComesAcross) {
  const auto device = opened(pincer());
  core::PointVectors force_n = core::zero_vectors();
  force_n[3].x() = 1.0;
  core::HapticState state;
  ASSERT_TRUE(comes_to([&] {
    (void)device->wait_for_sample(0);
    const bool is_read = device->read(state);
    (void)device->write(force_n);
    return is_read && state.acted_n[3].x() == 1.0;
  }));
  EXPECT_EQ(state.channels.bits, core::kAllChannels);
  EXPECT_DOUBLE_EQ(state.channels.force_n[3][0], 0.9);
  EXPECT_EQ(state.channels.orientation_wxyz, (std::array{0.6, 0.0, 0.0, 0.8}));
  EXPECT_EQ(state.channels.torque_n_m[1], 0.02);
  EXPECT_EQ(state.channels.gripper_m, 0.03);
  EXPECT_EQ(state.channels.buttons, 5U);
}

TEST_F(PincerPluginTest, ALoopOfAnotherRateIsRefusedWhereTheDeviceSetsThePace) {
  EXPECT_THROW((void)opened(pincer(), 500.0), core::Error);
  EXPECT_THROW((void)opened(pincer(",free=1,rate=500"), 1000.0), core::Error);
  EXPECT_NO_THROW((void)opened(pincer(",free=1,rate=4000"), 1000.0));
}

TEST_F(PincerPluginTest, ItHasNoPlaceInThisProcess) {
  EXPECT_NE(why_not(pincer(",in-process")).find("does not pace the loop"), std::string::npos);
}

/// The result of a loop in real time that the device paced for some seconds.
struct PacedRun {
  core::Telemetry telemetry;
  std::vector<core::Sample> samples;
};

PacedRun run_for(HapticDevice& device, double seconds, double rate_hz = 1000.0) {
  PacedRun run;
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  core::SpscQueue<core::Sample> samples(1 << 16);
  commands.publish({.sequence = 1,
                    .medium = core::viscous({.viscosity_pa_s = 5.0}),
                    .immersion = {.radius_m = 10.0, .depth_m = 10.0},
                    .ramp_s = 0.0});
  HapticLoop loop({.starts_armed = true, .rate_hz = rate_hz}, device,
                  {.commands = commands,
                   .telemetry = telemetry,
                   .emergency_stop = stop,
                   .samples = &samples});
  RealtimeThread thread({.lock_memory = false, .clear_cpu = false});
  start_haptics(device, loop, thread, true);
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
  thread.stop();
  device.close();
  telemetry.fetch();
  run.telemetry = telemetry.value();
  core::Sample sample;
  while (samples.try_pop(sample)) run.samples.push_back(sample);
  return run;
}

TEST_F(PincerPluginTest, EachMeasurementIsOneTickOfTheLoop) {
  const auto device = make_plugin_device(pincer(), 1000.0);
  const PacedRun run = run_for(*device, 2.0);
  ASSERT_GT(run.samples.size(), 1000U);
  std::set<std::int64_t> times_ns;
  for (const core::Sample& sample : run.samples) times_ns.insert(sample.device_time_ns);
  EXPECT_GE(static_cast<double>(times_ns.size()),
            0.95 * static_cast<double>(run.samples.size()))
      << "the same measurement was taken for two ticks";
  const core::Sample& last = run.samples.back();
  const double seconds =
      1e-9 * static_cast<double>(last.monotonic_ns - run.samples.front().monotonic_ns);
  EXPECT_NEAR(static_cast<double>(last.tick - run.samples.front().tick) / seconds, 1000.0, 20.0)
      << "a tick's number is its time";
  EXPECT_EQ(last.channels.bits, core::kAllChannels);
  EXPECT_EQ(core::measured_bits(last), 0b01100);
}

TEST_F(PincerPluginTest, ADeviceThatRunsWildMakesTheLoopHardlyFaster) {
  const auto device = make_plugin_device(pincer(",wild=2"), 1000.0);
  const PacedRun run = run_for(*device, 2.0);
  ASSERT_GT(run.samples.size(), 1000U);
  const core::Sample& last = run.samples.back();
  const double seconds =
      1e-9 * static_cast<double>(last.monotonic_ns - run.samples.front().monotonic_ns);
  // The bound leaves room for a sixteenth more, and for what a busy machine makes up for.
  EXPECT_LT(static_cast<double>(last.tick - run.samples.front().tick) / seconds, 1100.0);
}

TEST_F(PincerPluginTest, ADeviceThatSetsThePaceAndStopsIsAFaultAndTheLoopGoesOn) {
  const auto device = make_plugin_device(pincer(",stall=0.5"), 1000.0);
  const PacedRun run = run_for(*device, 2.5);
  EXPECT_GT(run.telemetry.num_faults, 0U);
  EXPECT_NE(run.telemetry.fault, Fault::kNone);
  double longest_s = 0.0;
  for (std::size_t i = 1; i < run.samples.size(); ++i) {
    longest_s =
        std::max(longest_s, 1e-9 * static_cast<double>(run.samples[i].monotonic_ns -
                                                       run.samples[i - 1].monotonic_ns));
  }
  EXPECT_LT(longest_s, 0.25) << "nothing waits for the driver";
  EXPECT_EQ(run.samples.back().tip_force_n, core::Sample().tip_force_n);
}

TEST_F(PincerPluginTest, ItsClockIsComparedWithOurs) {
  const auto device = make_plugin_device(pincer(",free=1,ppm=4000,rate=4000"), 1000.0);
  const PacedRun run = run_for(*device, 13.0);
  ASSERT_TRUE(run.telemetry.device_clock.has_value());
  // The drift is far above what a busy machine's delays add up to.
  EXPECT_NEAR(run.telemetry.device_clock->drift_ppm, 4000.0, 800.0);
  EXPECT_GE(run.telemetry.device_clock->observed_s, 10.0);
}

}  // namespace pincer_plugin_test
}  // namespace jnd::device
