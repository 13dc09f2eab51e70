#include "app/commissioning/measuring_steps.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>
#include <vector>

#include "analysis/commissioning/single_mass.h"
#include "app/commissioning/device_on_bench.h"
#include "app/commissioning/guided_pushes.h"
#include "app/commissioning/guided_stimuli.h"
#include "app/commissioning/guided_sweeps.h"
#include "app/commissioning/guided_ways.h"
#include "core/error.h"
#include "core/media/viscous_drag.h"
#include "core/safety/force_oscillation.h"
#include "device/stability.h"

namespace jnd::app {
namespace {

std::size_t first_point(const device::DeviceCapabilities& can) {
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (can.has_point(i)) return static_cast<std::size_t>(i);
  }
  throw core::Error("commission: expected a device with a contact point, found none");
}

}  // namespace

std::vector<Eigen::Vector3d> default_marks_m() {
  std::vector<Eigen::Vector3d> marks_m;
  for (const double x : {-0.1, 0.1}) {
    for (const double y : {-0.1, 0.1}) {
      for (const double z : {-0.25, -0.05}) marks_m.emplace_back(x, y, z);
    }
  }
  return marks_m;
}

analysis::NoiseFit noise_at_rest(DeviceOnBench& started) {
  started.run().run_for(0.5);
  const std::size_t point = first_point(started.can());
  std::vector<Eigen::Vector3d> position_m, velocity_m_per_s;
  started.run().run_for(2.0, [&](const core::Sample& sample) {
    position_m.push_back(vector_of(sample.tip_position_m[point]));
    velocity_m_per_s.push_back(vector_of(sample.tip_velocity_m_per_s[point]));
  });
  return analysis::fit_noise(position_m, velocity_m_per_s);
}

analysis::TouchedMark touched_mark(DeviceOnBench& started, device::Bench& bench,
                                   const Eigen::Vector3d& mark_m) {
  const std::size_t point = first_point(started.can());
  started.run().while_asking([&] { bench.touch(mark_m); });
  started.run().run_for(2.0);
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  int num_readings = 0;
  started.run().run_for(0.3, [&](const core::Sample& sample) {
    sum_m += vector_of(sample.tip_position_m[point]);
    ++num_readings;
  });
  return {.device_m = sum_m / num_readings, .workspace_m = mark_m};
}

analysis::HomingFit measure_homing(device::HapticDevice& device, device::Bench& bench,
                                   const MeasuringPlan& plan, const StepProgress& progress) {
  constexpr int kHomings = 3;
  constexpr double kParts = kHomings + 1;
  const GuidedRun::Parameters how{.rate_hz = plan.rate_hz,
                                  .allow_no_realtime = plan.allow_no_realtime,
                                  .emergency_stop = plan.emergency_stop,
                                  .watcher = plan.watcher};
  const device::DeviceCapabilities can = device.capabilities();
  bench.take_hand_out();
  bench.clamp();
  // A simulated device opens with a hand in it.
  const auto as_before = [&](GuidedRun& run) {
    device::Bench* const simulated = device.bench();
    if (simulated == nullptr) return;
    run.while_asking([simulated] {
      simulated->take_hand_out();
      simulated->clamp();
    });
  };
  const auto place_for = [&](GuidedRun& run, double duration_s) {
    Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
    double num_readings = 0.0;
    run.run_for(duration_s, [&](const core::Sample& sample) {
      sum_m += hand_m(sample, can);
      ++num_readings;
    });
    return Eigen::Vector3d(sum_m / num_readings);
  };
  std::vector<Eigen::Vector3d> homed_m;
  double moved_m = 0.0;
  for (int i = 0; i < kHomings; ++i) {
    progress(i / kParts,
             tr_later("The device is homed, and its tool rests where it did before."));
    // Nobody has the device open meanwhile, because its maker's own program may need it.
    bench.home();
    GuidedRun run(device, how);
    as_before(run);
    run.run_for(0.5);
    homed_m.push_back(place_for(run, 0.3));
    if (i + 1 < kHomings) continue;
    progress(kHomings / kParts, tr_later("The tool is let go of without force."));
    run.while_asking([&] { bench.let_go_without_force(); });
    // Looks no longer than it takes to see that the tool falls.
    constexpr double kLook_s = 0.05, kLongest_s = 1.0, kFalls_m = 0.05;
    for (double looked_s = 0.0; looked_s < kLongest_s && moved_m < kFalls_m;
         looked_s += kLook_s) {
      moved_m = std::max(moved_m, (place_for(run, kLook_s) - homed_m.back()).norm());
    }
    run.while_asking([&] { bench.clamp(); });
  }
  progress(1.0, "");
  return analysis::fit_homing(std::move(homed_m), moved_m);
}

analysis::NoiseFit measure_noise(device::HapticDevice& device, device::Bench& bench,
                                 const MeasuringPlan& plan, const StepProgress& progress) {
  DeviceOnBench started(device, bench, plan);
  progress(0.0, tr_later("The device rests; nothing may move it."));
  analysis::NoiseFit noise = noise_at_rest(started);
  started.run().stop();
  progress(1.0, "");
  return noise;
}

analysis::FrameFit measure_frame(device::HapticDevice& device, device::Bench& bench,
                                 const MeasuringPlan& plan, const StepProgress& progress) {
  DeviceOnBench started(device, bench, plan);
  const std::vector<Eigen::Vector3d> marks_m =
      plan.marks_m.empty() ? default_marks_m() : plan.marks_m;
  std::vector<analysis::TouchedMark> touched;
  for (const Eigen::Vector3d& mark_m : marks_m) {
    progress(static_cast<double>(touched.size()) / static_cast<double>(marks_m.size()),
             kMarkIsRead);
    touched.push_back(touched_mark(started, bench, mark_m));
  }
  started.run().stop();
  progress(1.0, "");
  return analysis::fit_frame(touched);
}

analysis::DelayFit measure_delay(device::HapticDevice& device, device::Bench& bench,
                                 const MeasuringPlan& plan, const analysis::ForceFit& force,
                                 const StepProgress& progress) {
  constexpr int kRounds = 12;
  DeviceOnBench started(device, bench, plan);
  started.hold(kSoftHold);
  GuidedPushes pushes(started, plan);
  pushes.go(started.place_m(), kRounds, [&](int round) {
    progress(static_cast<double>(round) / kRounds,
             tr_later("The device is pushed to and fro as it moves."));
  });
  started.run().stop();
  progress(1.0, "");
  return pushes.fit(force.damping_n_s_per_m.value / force.gain.value);
}

analysis::ForceFit fit_ways(const GuidedWays& ways, const GuidedPushes& pushes,
                            const Eigen::Vector3d& up, double load_uncertainty_ratio) {
  const auto fitted = [&](double damping_per_gain) {
    const analysis::DelayFit roughly = pushes.fit(damping_per_gain);
    return analysis::fit_force(ways.ways(roughly.delay_s.value), up,
                               roughly.mass_per_gain_kg.value, load_uncertainty_ratio);
  };
  // The delay of a force is found better once the damping that opposes the pushes is known, and
  // that damping is found better once the delay is known.
  const analysis::ForceFit first = fitted(0.0);
  return fitted(std::max(0.0, first.damping_n_s_per_m.value / first.gain.value));
}

analysis::ForceFit measure_force(device::HapticDevice& device, device::Bench& bench,
                                 const MeasuringPlan& plan, const analysis::FrameFit& frame,
                                 const StepProgress& progress) {
  // These are mean speeds of smooth ways, whose highest speed is nearly twice as much.
  constexpr std::array kSpeeds_m_per_s = {0.035, 0.07, 0.14, 0.21};
  constexpr double kLoadedSpeed_m_per_s = 0.035;
  constexpr std::array kHeights_m = {-0.04, 0.0, 0.04};
  constexpr double kHalfWay_m = 0.08, kLoadedHalfWay_m = 0.05;
  constexpr int kRounds = 2;

  DeviceOnBench started(device, bench, plan);
  started.hold(kSoftHold);
  const Eigen::Vector3d home_m = started.place_m();
  // Finds roughly how heavy the device is and how late it acts, so that it can be guided.
  GuidedPushes pushes(started, plan);
  pushes.go(home_m, 3,
            [&](int) { progress(0.0, tr_later("The device is pushed to and fro.")); });
  // The axes of the workspace in the device's own frame.
  const Eigen::Matrix3d to_device = frame.rotation.transpose();
  const Eigen::Vector3d up = to_device.col(2);
  GuidedWays ways(started, plan, pushes.fit(0.0).mass_per_gain_kg.value);
  const double num_parts = kRounds * 3.0 + static_cast<double>(plan.loads_kg.size() + 1);
  double done = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    for (int axis = 0; axis < 3; ++axis) {
      progress(done++ / num_parts, tr_later("The device goes to and fro, with nothing on it."));
      for (const double speed_m_per_s : kSpeeds_m_per_s) {
        ways.go(home_m, to_device.col(axis), kHalfWay_m, speed_m_per_s, {});
      }
    }
  }
  std::vector<double> loads_kg = plan.loads_kg;
  loads_kg.insert(loads_kg.begin(), 0.0);
  for (const double load_kg : loads_kg) {
    progress(done++ / num_parts, tr_later("The device lifts and lowers a load."));
    started.act([&] { bench.hang(load_kg); });
    for (int pose = 0; pose < static_cast<int>(kHeights_m.size()); ++pose) {
      const Eigen::Vector3d middle_m = home_m + kHeights_m[static_cast<std::size_t>(pose)] * up;
      for (int round = 0; round < kRounds; ++round) {
        ways.go(middle_m, up, kLoadedHalfWay_m, kLoadedSpeed_m_per_s,
                {.load_kg = load_kg, .pose = pose});
      }
    }
  }
  // There is no force while the last load is taken off.
  started.run().stop();
  bench.hang(0.0);
  progress(1.0, "");
  return fit_ways(ways, pushes, up, plan.load_uncertainty_ratio);
}

namespace {

/// No study asks for more.
constexpr double kThickest_pa_s = 512.0;
constexpr device::StabilityLadder kStiffnesses_n_per_m = {
    .first = 50.0, .last = 51200.0, .resolution_ratio = 1.1};
/// Reduces a measured limit, because of what was not measured: other poses, or a warmer motor.
constexpr double kSafeRatio = 0.97;
/// The factor of each further try, and the most tries.
constexpr double kLessRatio = 0.9;
constexpr int kMostTries = 40;

/// The limit of all poses together, unless one pose is worse than that by more than its noise.
analysis::DampingLimit worst_of(const std::vector<GuidedSweeps>& poses, double period_s,
                                double delay_s, double largest_n_s_per_m) {
  const Eigen::VectorXd shares = poses.front().share_ratio();
  const auto limit = [&](const std::vector<analysis::SweptWay>& ways) {
    return analysis::damping_limit(ways, shares, period_s, delay_s, largest_n_s_per_m);
  };
  std::vector<analysis::SweptWay> all;
  for (const GuidedSweeps& pose : poses) {
    all.insert(all.end(), pose.ways().begin(), pose.ways().end());
  }
  analysis::DampingLimit worst = limit(all);
  for (const GuidedSweeps& pose : poses) {
    const analysis::DampingLimit its = limit(pose.ways());
    if (its.damping_n_s_per_m.ci95_high < worst.damping_n_s_per_m.ci95_low) worst = its;
  }
  return worst;
}

/// Measures the limit by the response to sweeps around three places, 9 cm apart.
analysis::DampingLimit measure_damping_limit(device::HapticDevice& device, device::Bench& bench,
                                             const MeasuringPlan& plan, double delay_s,
                                             double largest_n_s_per_m,
                                             const StepProgress& progress) {
  constexpr std::array kOffsets_m = {0.0, 0.05, -0.05};
  constexpr int kRounds = 2;
  // A sweep reaches half of the loop's rate, so the force goes to one side in one tick and to
  // the other in the next.
  GuidedRun::Parameters how;
  how.limits.slew_n_per_s = 2.0 * GuidedSweeps::kSweep_n * plan.rate_hz;
  DeviceOnBench started(device, bench, plan, how);
  started.hold(kSoftHold);
  const Eigen::Vector3d home_m = started.place_m();
  std::vector<GuidedSweeps> poses;
  for (const double offset_m : kOffsets_m) {
    const auto pose = static_cast<double>(poses.size());
    GuidedSweeps& sweeps = poses.emplace_back(started, plan);
    sweeps.go(home_m + Eigen::Vector3d::Constant(offset_m), kRounds, [&](int input) {
      progress(0.3 * (pose + static_cast<double>(input) / sweeps.num_inputs()),
               "The device is swept through all frequencies as it moves.");
    });
  }
  started.run().stop();
  return worst_of(poses, 1.0 / plan.rate_hz, delay_s, largest_n_s_per_m);
}

/// The first of these values that works, each a tenth less than the one before; 0 if none does.
double first_that(double from, const std::function<bool(double)>& works) {
  for (int tries = 0; tries < kMostTries; ++tries, from *= kLessRatio) {
    if (works(from)) return from;
  }
  return 0.0;
}

}  // namespace

analysis::StabilityFit measure_stability(device::HapticDevice& device, device::Bench& bench,
                                         const MeasuringPlan& plan,
                                         const analysis::NoiseFit& noise,
                                         const analysis::ForceFit& force,
                                         const analysis::DelayFit& delay,
                                         const StepProgress& progress) {
  const double shape_m = core::ViscousDrag({.viscosity_pa_s = 0.0}).shape_constant_m();
  analysis::StabilityFit fit{.rate_hz = plan.rate_hz,
                             .is_single_mass = analysis::is_single_mass(delay, force)};
  fit.damping = measure_damping_limit(device, bench, plan, std::max(0.0, delay.delay_s.value),
                                      kThickest_pa_s * shape_m / kSafeRatio, progress);
  fit.viscosity_pa_s = kSafeRatio * fit.damping.damping_n_s_per_m.ci95_low / shape_m;

  // The limits of the force are as before, and everything else is as in a session.
  constexpr core::ForceLimiter::Parameters kSession;
  GuidedRun::Parameters how{.swing_n = core::ForceOscillation::Parameters().swing_n};
  how.limits.slew_n_per_s = kSession.slew_n_per_s;
  DeviceOnBench started(device, bench, plan, how);
  started.hold(kSoftHold);
  GuidedStimuli stimuli(started, noise, force);
  progress(0.9, "The device is drawn through the thickest fluid that this allows.");
  fit.quiet_viscosity_pa_s = first_that(fit.viscosity_pa_s, [&](double viscosity_pa_s) {
    return stimuli.is_drawn_through(viscosity_pa_s * shape_m);
  });
  progress(0.95, "The device rests on something solid.");
  const auto rests = [&](double stiffness_n_per_m) {
    return stimuli.rests_on(stiffness_n_per_m);
  };
  if (fit.is_single_mass) {
    const double limit_n_per_m =
        kSafeRatio * analysis::stiffness_limit(delay, force, 1.0 / plan.rate_hz).ci95_low;
    // The device would sink by 10 cm into anything softer.
    fit.stiffness_n_per_m = limit_n_per_m < kStiffnesses_n_per_m.first
                                ? limit_n_per_m
                                : first_that(limit_n_per_m, rests);
  } else {
    const device::StabilityLimit limit = device::largest_stable(kStiffnesses_n_per_m, rests);
    // The limit was found to the next rung only and on one solid, so the profile states less,
    // and never "or more".
    fit.stiffness_n_per_m = kLessRatio * limit.value;
  }
  started.run().stop();
  progress(1.0, "");
  return fit;
}

}  // namespace jnd::app
