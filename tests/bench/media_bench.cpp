#include <benchmark/benchmark.h>

#include "core/media/medium.h"
#include "device/haptic_loop.h"
#include "device/lumped_hand_device.h"

namespace jnd {
namespace {

core::ForceMap map_with_lift() {
  return core::ForceMap({{0.0, 1.0, 0.2, 0.0}, {0.8, 1.0, 0.6, 0.5}, {1.571, 1.0, 0.9, 0.0}});
}

/// Measures one full tick of a stroking hand, as `full_tick` does, in this medium.
void tick_in(benchmark::State& state, const core::MediumAmounts& medium) {
  const core::ForceMap map = map_with_lift();
  device::LumpedHandDevice hand({});
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  device::HapticLoop loop({.starts_armed = true, .force_map = &map}, hand,
                          {commands, telemetry, stop});
  hand.open();
  commands.publish({.sequence = 1,
                    .medium = medium,
                    .immersion = {.radius_m = 1.0, .depth_m = 2.0, .origin_z_m = 1.0}});
  hand.simulated_hand()->begin_strokes({}, core::RandomStream(1, "bench"));
  for (auto _ : state) loop.tick();
}

void tick_free_space(benchmark::State& state) { tick_in(state, core::free_space()); }
void tick_water_map(benchmark::State& state) { tick_in(state, core::mapped_water({})); }
void tick_schiller_naumann(benchmark::State& state) {
  tick_in(state, core::viscous_inertial({.viscosity_pa_s = 1.853}));
}
void tick_ellipsoid(benchmark::State& state) {
  tick_in(state, core::ellipsoid({.viscosity_pa_s = 1.853}));
}
void tick_bucket(benchmark::State& state) {
  tick_in(state, core::viscous({.viscosity_pa_s = 1.853}) +
                     core::container({.stiffness_n_per_m = 500.0, .friction_ratio = 0.3}));
}
BENCHMARK(tick_free_space);
BENCHMARK(tick_water_map);
BENCHMARK(tick_schiller_naumann);
BENCHMARK(tick_ellipsoid);
BENCHMARK(tick_bucket);

}  // namespace
}  // namespace jnd
