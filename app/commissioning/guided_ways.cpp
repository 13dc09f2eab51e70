#include "app/commissioning/guided_ways.h"

#include <algorithm>
#include <array>

namespace jnd::app {
namespace {

constexpr double kGravity_m_per_s2 = 9.80665;

/// A critically damped hold for a device of this mass, in commanded newtons.
GuideOrder holding(double mass_per_gain_kg) {
  constexpr double kRate_rad_per_s = 20.0;
  return {.stiffness_n_per_m = kRate_rad_per_s * kRate_rad_per_s * mass_per_gain_kg,
          .damping_n_s_per_m = 2.0 * kRate_rad_per_s * mass_per_gain_kg,
          .is_on = true};
}

/// The force that acted at the time of each position.
std::vector<double> delayed(const std::vector<double>& force_n, double delay_ticks) {
  const auto whole = static_cast<std::size_t>(delay_ticks);
  const double part = delay_ticks - static_cast<double>(whole);
  std::vector<double> acting_n(force_n.size(), 0.0);
  for (std::size_t i = whole + 1; i < force_n.size(); ++i) {
    acting_n[i] = (1.0 - part) * force_n[i - whole] + part * force_n[i - whole - 1];
  }
  return acting_n;
}

}  // namespace

GuidedWays::GuidedWays(DeviceOnBench& started, const MeasuringPlan& plan,
                       double mass_per_gain_kg)
    : started_(started),
      period_s_(1.0 / plan.rate_hz),
      order_(holding(mass_per_gain_kg)),
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
  order_.is_smooth = true;
  started_.run().order(order_);
  Recorded& way = ways_.emplace_back(Recorded{.along = along, .setting = setting});
  const auto record = [&](const core::Sample& sample) {
    way.position_m.push_back(hand_m(sample, started_.can()).dot(along));
    way.commanded_n.push_back(commanded_n(sample).dot(along));
  };
  started_.run().run_for(2.0 * half_way_m / speed_m_per_s, record);
  started_.come_to_rest(record);
}

std::vector<analysis::GuidedWay> GuidedWays::ways(double delay_s) const {
  // A force is held for a whole tick, so on average it acts half a tick later.
  const double delay_ticks = 0.5 + std::max(0.0, delay_s) / period_s_;
  std::vector<analysis::GuidedWay> all;
  for (const Recorded& way : ways_) {
    all.push_back(analysis::guided_way(
        way.along, way.position_m, delayed(way.commanded_n, delay_ticks), period_s_,
        way.setting.load_kg * kGravity_m_per_s2, way.setting.pose));
  }
  return all;
}

}  // namespace jnd::app
