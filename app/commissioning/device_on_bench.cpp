#include "app/commissioning/device_on_bench.h"

#include <fmt/format.h>

#include <Eigen/Geometry>

#include "core/error.h"

namespace jnd::app {

Eigen::Vector3d vector_of(const core::PlainVector& plain) noexcept {
  return {plain[0], plain[1], plain[2]};
}

std::array<double, 3> plain_of(const Eigen::Vector3d& vector) noexcept {
  return {vector.x(), vector.y(), vector.z()};
}

Eigen::Vector3d hand_m(const core::Sample& sample,
                       const device::DeviceCapabilities& can) noexcept {
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (can.has_point(i))
      sum_m += vector_of(sample.tip_position_m[static_cast<std::size_t>(i)]);
  }
  return sum_m / can.num_contact_points();
}

Eigen::Vector3d commanded_n(const core::Sample& sample) noexcept {
  Eigen::Vector3d sum_n = Eigen::Vector3d::Zero();
  for (const core::PlainVector& force_n : sample.tip_force_n) sum_n += vector_of(force_n);
  return sum_n;
}

DeviceOnBench::DeviceOnBench(device::HapticDevice& device, device::Bench& bench,
                             const MeasuringPlan& plan, const GuidedRun::Parameters& how)
    : bench_(bench),
      can_(device.capabilities()),
      run_(device, {.rate_hz = plan.rate_hz,
                    .limits = how.limits,
                    .swing_n = how.swing_n,
                    .allow_no_realtime = plan.allow_no_realtime,
                    .emergency_stop = plan.emergency_stop,
                    .watcher = plan.watcher}) {
  run_.while_asking([&bench] {
    bench.take_hand_out();
    bench.clamp();
  });
}

Eigen::Vector3d DeviceOnBench::place_m() {
  Eigen::Vector3d last_m = Eigen::Vector3d::Zero();
  run_.run_for(0.02, [&](const core::Sample& sample) { last_m = hand_m(sample, can_); });
  return last_m;
}

/// Somebody holds it and may have moved it since it was held last: it is held from where it is
/// now, and whatever pulls it from there ends.
void DeviceOnBench::take_over(GuideOrder order) {
  // Where the softest hold comes to 0.5 N, with which `jnd device-check` pushes a real device.
  constexpr double kGentle_n = 0.5;
  constexpr double kMostYield_m = kGentle_n / kSoftHold.stiffness_n_per_m;
  run_.while_asking([this] { bench_.expect_force(); });
  // Whether what is latched lets it be armed is for `arm` to judge: no force acts before.
  const Eigen::Vector3d held_m = hand_m(run_.look(), can_);
  order.to_m = plain_of(held_m);
  order.begins_here = true;
  run_.order(order);
  run_.arm([&](const core::Sample& sample) {
    const double yield_m = (hand_m(sample, can_) - held_m).norm();
    if (yield_m <= kMostYield_m) return;
    run_.disarm();
    throw core::Error(fmt::format(
        "device: expected the tool to stay where somebody holds it while the force grows, "
        "found that it moved by {:.0f} mm, and there is no force any more; hold it firmly, or "
        "let it rest on something, then measure this step again",
        1e3 * yield_m));
  });
}

void DeviceOnBench::hold(GuideOrder order) {
  take_over(order);
  run_.run_for(0.2);
  run_.while_asking([this] { bench_.let_go(); });
  run_.run_for(1.0);
}

void DeviceOnBench::act(const std::function<void()>& act) {
  run_.while_asking([this] { bench_.clamp(); });
  run_.without_force(act);
  take_over(run_.ordered());
  run_.while_asking([this] { bench_.let_go(); });
  run_.run_for(1.0);
}

void DeviceOnBench::go_to(const Eigen::Vector3d& place_m, GuideOrder order) {
  constexpr double kPace_m_per_s = 0.2;
  const double way_m = (this->place_m() - place_m).norm();
  order.to_m = plain_of(place_m);
  order.speed_m_per_s = kPace_m_per_s;
  run_.order(order);
  run_.run_for(way_m / kPace_m_per_s + 0.3);
  come_to_rest();
}

void DeviceOnBench::come_to_rest(const std::function<void(const core::Sample&)>& take) {
  constexpr double kAtRest_m = 0.0003, kPart_s = 0.2, kLongestSway_s = 4.0;
  for (double waited_s = 0.0; waited_s < kLongestSway_s; waited_s += kPart_s) {
    Eigen::AlignedBox3d been_m;
    run_.run_for(kPart_s, [&](const core::Sample& sample) {
      been_m.extend(hand_m(sample, can_));
      if (take) take(sample);
    });
    if (been_m.sizes().norm() < kAtRest_m) return;
  }
}

}  // namespace jnd::app
