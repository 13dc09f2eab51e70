#include "app/commissioning/guided_pushes.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace jnd::app {

GuidedPushes::GuidedPushes(DeviceOnBench& started, const MeasuringPlan& plan)
    : started_(started),
      period_s_(1.0 / plan.rate_hz),
      push_ticks_(2 * static_cast<int>(std::lround(0.5 * kPush_s * plan.rate_hz))),
      random_(plan.seed, "commissioning pushes") {}

void GuidedPushes::go(const Eigen::Vector3d& middle_m, int num_rounds,
                      const std::function<void(int)>& tell) {
  for (int round = 0; round < num_rounds; ++round) {
    tell(round);
    GuideOrder order = kFirmHold;
    const Eigen::Vector3d about_m =
        middle_m + random_.uniform(-0.015, 0.015) * Eigen::Vector3d::UnitX();
    started_.go_to(about_m - kHalfWay_m * Eigen::Vector3d::UnitX(), order);
    for (const double sense : {1.0, -1.0}) {
      order.to_m = plain_of(about_m + sense * kHalfWay_m * Eigen::Vector3d::UnitX());
      order.speed_m_per_s = kSpeed_m_per_s;
      order.pulse_n = {push_n_, 0.0, 0.0};
      order.pulse_period_s = push_ticks_ * period_s_;
      started_.run().order(order);
      take_windows(sense);
      order.pulse_period_s = 0.0;
      started_.run().order(order);
      started_.run().run_for(0.4);
    }
  }
}

analysis::DelayFit GuidedPushes::fit(double damping_per_gain) const {
  return analysis::fit_delay(windows_, period_s_, push_ticks_, damping_per_gain);
}

void GuidedPushes::take_windows(double sense) {
  constexpr int kPushesInWindow = 10;
  const std::size_t window_ticks = static_cast<std::size_t>(push_ticks_) * kPushesInWindow;
  ++num_ways_;
  std::vector<double> position_m, force_n;
  double slowest_m_per_s = kSpeed_m_per_s;
  const double duration_s = 2.0 * kHalfWay_m / kSpeed_m_per_s;
  started_.run().run_for(kGathering_s);
  started_.run().run_for(duration_s - kGathering_s - 0.05, [&](const core::Sample& sample) {
    position_m.push_back(hand_m(sample, started_.can()).x());
    force_n.push_back(commanded_n(sample).x());
    constexpr std::size_t kReach = 5;
    if (position_m.size() > kReach) {
      const double way_m = position_m.back() - position_m[position_m.size() - 1 - kReach];
      slowest_m_per_s = std::min(slowest_m_per_s, sense * way_m / (kReach * period_s_));
    }
  });
  if (slowest_m_per_s < 0.2 * kSpeed_m_per_s) {
    // A light device turned back. The next pushes are softer, and these windows are not used.
    push_n_ *= 0.6;
    return;
  }
  for (std::size_t first = 0; first + window_ticks <= position_m.size();
       first += window_ticks) {
    const auto part = [&](const std::vector<double>& all) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
      return std::vector<double>(begin, begin + static_cast<std::ptrdiff_t>(window_ticks));
    };
    windows_.push_back(
        {.position_m = part(position_m), .commanded_n = part(force_n), .way = num_ways_});
  }
}

}  // namespace jnd::app
