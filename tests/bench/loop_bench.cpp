#include <benchmark/benchmark.h>

#include <cmath>

#include "core/exchange/haptic_command.h"
#include "core/exchange/latest_value.h"
#include "core/exchange/spsc_queue.h"
#include "core/exchange/telemetry.h"
#include "core/safety/emergency_stop.h"
#include "device/haptic_loop.h"
#include "device/lumped_hand_device.h"

namespace jnd {
namespace {

/// Measures one full tick with the lumped hand: read, kinematics, drag, immersion,
/// distribution, passivity, limiter, write, sample, telemetry. The queue is emptied outside of
/// the measured time.
void full_tick(benchmark::State& state) {
  device::LumpedHandDevice hand({});
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  core::SpscQueue<core::Sample> samples(4096);
  device::HapticLoop loop({.starts_armed = true}, hand,
                          {.commands = commands,
                           .telemetry = telemetry,
                           .emergency_stop = stop,
                           .samples = &samples});
  hand.open();
  commands.publish({.sequence = 1,
                    .medium = core::viscous({.viscosity_pa_s = 1.853}),
                    .immersion = {.origin_z_m = 1.0}});
  hand.simulated_hand()->begin_strokes({}, core::RandomStream(1, "bench"));
  for (auto _ : state) {
    loop.tick();
    if (samples.num_free() == 0) {
      state.PauseTiming();
      samples.drain([](const core::Sample&) {});
      state.ResumeTiming();
    }
  }
}
BENCHMARK(full_tick);

/// Measures the reference in the same run: the sine that a simple stroke would compute in every
/// tick.
void reference_sine(benchmark::State& state) {
  double x = 0.1;
  for (auto _ : state) {
    x = std::sin(x) + 1.0;
    benchmark::DoNotOptimize(x);
  }
}
BENCHMARK(reference_sine);

}  // namespace
}  // namespace jnd
