#include "app/commissioning/guided_ways.h"

#include <algorithm>
#include <array>

namespace jnd::app {
namespace {

constexpr double kGravity_m_per_s2 = 9.80665;

/// A critically damped hold of a device of this mass, in newtons commanded.
GuideOrder holding(double mass_per_gain_kg) {
  constexpr double kRate_rad_per_s = 20.0;
  return {.stiffness_n_per_m = kRate_rad_per_s * kRate_rad_per_s * mass_per_gain_kg,
          .damping_n_s_per_m = 2.0 * kRate_rad_per_s * mass_per_gain_kg,
          .is_on = true};
}

}  // namespace

GuidedWays::GuidedWays(DeviceOnBench& started, const MeasuringPlan& plan,
                       const analysis::DelayFit& roughly)
    : started_(started),
      period_s_(1.0 / plan.rate_hz),
      order_(holding(roughly.mass_per_gain_kg.value)),
      // A force stands for a tick, so it acts half a tick later on the whole.
      delay_ticks_(0.5 + std::max(0.0, roughly.delay_s.value) * plan.rate_hz),
      random_(plan.seed, "commissioning ways") {}

void GuidedWays::go(const Eigen::Vector3d& middle_m, const Eigen::Vector3d& direction,
                    double half_way_m, double speed_m_per_s, const WaySetting& setting) {
  const Eigen::Vector3d shifted_m = middle_m + random_.uniform(-0.015, 0.015) * direction;
  started_.go_to(shifted_m - half_way_m * direction, order_);
  for (const double sense : {1.0, -1.0}) {
    one_way(shifted_m + sense * half_way_m * direction, sense * direction, half_way_m,
            speed_m_per_s, setting);
  }
}

void GuidedWays::one_way(const Eigen::Vector3d& end_m, const Eigen::Vector3d& along,
                         double half_way_m, double speed_m_per_s, const WaySetting& setting) {
  order_.to_m = plain_of(end_m);
  order_.speed_m_per_s = speed_m_per_s;
  started_.run().order(order_);
  const double duration_s = 2.0 * half_way_m / speed_m_per_s;
  std::vector<double> position_m, force_n;
  started_.run().run_for(duration_s, [&](const core::Sample& sample) {
    position_m.push_back(hand_m(sample, started_.can()).dot(along));
    force_n.push_back(commanded_n(sample).dot(along));
  });
  // Speed is gathered in the first part, and lost again at the end.
  const auto part = [&](double ratio) {
    return static_cast<std::ptrdiff_t>(ratio * static_cast<double>(position_m.size()));
  };
  const auto within = [&](const std::vector<double>& all) {
    return std::vector<double>(all.begin() + part(0.45), all.begin() + part(0.97));
  };
  ways_.push_back(analysis::guided_way(along, within(position_m), within(delayed(force_n)),
                                       period_s_, setting.load_kg * kGravity_m_per_s2,
                                       setting.pose));
  started_.run().run_for(0.2);  // To rest.
}

std::vector<double> GuidedWays::delayed(const std::vector<double>& force_n) const {
  const auto whole = static_cast<std::size_t>(delay_ticks_);
  const double part = delay_ticks_ - static_cast<double>(whole);
  std::vector<double> acting_n(force_n.size(), 0.0);
  for (std::size_t i = whole + 1; i < force_n.size(); ++i) {
    acting_n[i] = (1.0 - part) * force_n[i - whole] + part * force_n[i - whole - 1];
  }
  return acting_n;
}

}  // namespace jnd::app
