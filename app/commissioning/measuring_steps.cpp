#include "app/commissioning/measuring_steps.h"

#include <array>
#include <string>

#include "app/commissioning/device_on_bench.h"
#include "app/commissioning/guided_pushes.h"
#include "app/commissioning/guided_ways.h"
#include "core/error.h"

namespace jnd::app {
namespace {

int first_point(const device::DeviceCapabilities& can) {
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (can.has_point(i)) return i;
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

analysis::NoiseFit measure_noise(device::HapticDevice& device, device::Bench& bench,
                                 const MeasuringPlan& plan, const StepProgress& progress) {
  DeviceOnBench started(device, bench, plan);
  progress(0.0, "The device rests; nothing may move it.");
  started.run().run_for(0.5);
  const auto point = static_cast<std::size_t>(first_point(started.can()));
  std::vector<Eigen::Vector3d> position_m, velocity_m_per_s;
  started.run().run_for(2.0, [&](const core::Sample& sample) {
    position_m.push_back(vector_of(sample.tip_position_m[point]));
    velocity_m_per_s.push_back(vector_of(sample.tip_velocity_m_per_s[point]));
  });
  started.run().stop();
  progress(1.0, "");
  return analysis::fit_noise(position_m, velocity_m_per_s);
}

analysis::FrameFit measure_frame(device::HapticDevice& device, device::Bench& bench,
                                 const MeasuringPlan& plan, const StepProgress& progress) {
  DeviceOnBench started(device, bench, plan);
  const auto point = static_cast<std::size_t>(first_point(started.can()));
  const std::vector<Eigen::Vector3d> marks_m =
      plan.marks_m.empty() ? default_marks_m() : plan.marks_m;
  std::vector<analysis::TouchedMark> touched;
  for (const Eigen::Vector3d& mark_m : marks_m) {
    progress(static_cast<double>(touched.size()) / static_cast<double>(marks_m.size()),
             "Mark " + std::to_string(touched.size() + 1) + " of " +
                 std::to_string(marks_m.size()) + " is touched.");
    started.run().while_asking([&] { bench.touch(mark_m); });
    started.run().run_for(2.0);
    Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
    int num_readings = 0;
    started.run().run_for(0.3, [&](const core::Sample& sample) {
      sum_m += vector_of(sample.tip_position_m[point]);
      ++num_readings;
    });
    touched.push_back({.device_m = sum_m / num_readings, .workspace_m = mark_m});
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
             "The device is pushed to and fro as it moves.");
  });
  started.run().stop();
  progress(1.0, "");
  const analysis::DelayFit fit = pushes.fit(force.damping_n_s_per_m.value / force.gain.value);
  analysis::require_single_mass(fit);
  return fit;
}

analysis::ForceFit measure_force(device::HapticDevice& device, device::Bench& bench,
                                 const MeasuringPlan& plan, const analysis::FrameFit& frame,
                                 const StepProgress& progress) {
  constexpr std::array kSpeeds_m_per_s = {0.05, 0.1, 0.2, 0.3};
  constexpr std::array kLoadedSpeeds_m_per_s = {0.05, 0.15};
  constexpr std::array kHeights_m = {-0.04, 0.0, 0.04};
  constexpr double kHalfWay_m = 0.08, kLoadedHalfWay_m = 0.05;
  constexpr int kRounds = 2;

  DeviceOnBench started(device, bench, plan);
  started.hold(kSoftHold);
  const Eigen::Vector3d home_m = started.place_m();
  // How heavy and how late it is, roughly, for whoever guides it.
  GuidedPushes pushes(started, plan);
  pushes.go(home_m, 3, [&](int) { progress(0.0, "The device is pushed to and fro."); });
  // Along the axes of the workspace, as the device has them.
  const Eigen::Matrix3d to_device = frame.rotation.transpose();
  const Eigen::Vector3d up = to_device.col(2);
  const analysis::DelayFit roughly = pushes.fit(0.0);
  GuidedWays ways(started, plan, roughly);
  const double num_parts = kRounds * 3.0 + static_cast<double>(plan.loads_kg.size() + 1);
  double done = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    for (int axis = 0; axis < 3; ++axis) {
      progress(done++ / num_parts, "The device goes to and fro, with nothing on it.");
      for (const double speed_m_per_s : kSpeeds_m_per_s) {
        ways.go(home_m, to_device.col(axis), kHalfWay_m, speed_m_per_s, {});
      }
    }
  }
  std::vector<double> loads_kg = plan.loads_kg;
  loads_kg.insert(loads_kg.begin(), 0.0);
  for (const double load_kg : loads_kg) {
    progress(done++ / num_parts, "The device lifts and lowers a load.");
    started.act([&] { bench.hang(load_kg); });
    for (int pose = 0; pose < static_cast<int>(kHeights_m.size()); ++pose) {
      const Eigen::Vector3d middle_m = home_m + kHeights_m[static_cast<std::size_t>(pose)] * up;
      for (const double speed_m_per_s : kLoadedSpeeds_m_per_s) {
        ways.go(middle_m, up, kLoadedHalfWay_m, speed_m_per_s,
                {.load_kg = load_kg, .pose = pose});
      }
    }
  }
  started.run().stop();  // No force while the last load is taken off.
  bench.hang(0.0);
  progress(1.0, "");
  return analysis::fit_force(ways.ways(), up, roughly.mass_per_gain_kg.value,
                             plan.load_uncertainty_ratio);
}

}  // namespace jnd::app
