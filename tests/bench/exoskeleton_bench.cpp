#include <benchmark/benchmark.h>

#include "core/random_stream.h"
#include "device/exoskeleton/exoskeleton_device.h"
#include "device/haptic_loop.h"

namespace jnd {
namespace {

/// Measures the exoskeleton's own control in one tick: filter, kinematics, J^T, protection,
/// feed-forward, friction compensation and gravity, without physics.
void exoskeleton_control(benchmark::State& state) {
  device::ExoskeletonKinematics kinematics(Eigen::Vector3d::Zero());
  device::TorqueControl control({.feed_forward_gain_ratio = 0.3}, 0.001);
  device::VelocityFilter filter(40.0, 0.001);
  device::TorqueControl::Measured measured;
  measured.position_rad = device::neutral_pose_rad();
  core::PointVectors force_n;
  force_n.fill({1.0, -0.5, 0.2});
  for (auto _ : state) {
    measured.position_rad[3] += 1e-9;
    measured.velocity_rad_per_s = filter.update(measured.position_rad);
    kinematics.update(measured.position_rad);
    benchmark::DoNotOptimize(kinematics.tip_velocity_m_per_s(measured.velocity_rad_per_s));
    benchmark::DoNotOptimize(control.torque_n_m(kinematics, measured, force_n));
  }
}
BENCHMARK(exoskeleton_control);

/// Measures one step of the simulated world, in which the hand is drawn along.
void exoskeleton_physics(benchmark::State& state) {
  device::ExoskeletonDevice exoskeleton({});
  device::MujocoWorld world({.base_m = exoskeleton.kinematics().base_position_m()});
  const device::JointVector torque_n_m = exoskeleton.kinematics().gravity_torque_n_m();
  double sign = 1.0;
  std::int64_t tick = 0;
  for (auto _ : state) {
    if (++tick % 200 == 0) sign = -sign;
    benchmark::DoNotOptimize(world.step(torque_n_m, {8.0 * sign, 0.0, 0.0}));
  }
}
BENCHMARK(exoskeleton_physics);

/// Measures a whole tick of the loop with the simulated exoskeleton in a fluid, including
/// physics.
void exoskeleton_tick(benchmark::State& state) {
  device::ExoskeletonDevice exoskeleton({});
  core::LatestValue<core::HapticCommand> commands;
  core::LatestValue<core::Telemetry> telemetry;
  core::EmergencyStop stop;
  device::HapticLoop loop({.starts_armed = true}, exoskeleton, {commands, telemetry, stop});
  commands.publish({.sequence = 1, .medium = core::viscous({.viscosity_pa_s = 4.0})});
  exoskeleton.simulated_hand()->begin_strokes({}, core::RandomStream(1, "bench"));
  for (auto _ : state) loop.tick();
}
BENCHMARK(exoskeleton_tick);

}  // namespace
}  // namespace jnd
