#include "app/commissioning/guided_sweeps.h"

#include <cmath>
#include <utility>

namespace jnd::app {

GuidedSweeps::GuidedSweeps(DeviceOnBench& started, const MeasuringPlan& plan)
    : started_(started),
      rate_hz_(plan.rate_hz),
      sweep_ticks_(4 * static_cast<int>(std::lround(0.25 * kSweep_s * plan.rate_hz))),
      random_(plan.seed, "commissioning sweeps") {
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    if (started.can().has_point(point)) points_.push_back(point);
  }
}

Eigen::VectorXd GuidedSweeps::share_ratio() const {
  Eigen::VectorXd shares(num_inputs());
  for (int input = 0; input < num_inputs(); ++input) {
    const auto point = static_cast<std::size_t>(points_[static_cast<std::size_t>(input / 3)]);
    shares[input] = started_.can().share_ratio[point];
  }
  return shares;
}

void GuidedSweeps::go(const Eigen::Vector3d& middle_m, int num_rounds,
                      const std::function<void(int)>& tell) {
  for (int input = 0; input < num_inputs(); ++input) {
    tell(input);
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(input % 3);
    for (int round = 0; round < num_rounds; ++round) {
      const Eigen::Vector3d about_m = middle_m + random_.uniform(-0.015, 0.015) * along;
      started_.go_to(about_m - kHalfWay_m * along, kFirmHold);
      one_way(input, about_m + kHalfWay_m * along);
      one_way(input, about_m - kHalfWay_m * along);
    }
  }
}

void GuidedSweeps::one_way(int input, const Eigen::Vector3d& end_m) {
  GuideOrder order = kFirmHold;
  order.to_m = plain_of(end_m);
  order.speed_m_per_s = kSpeed_m_per_s;
  order.sweep_n = kSweep_n;
  order.sweep_ticks = sweep_ticks_;
  order.sweep_point = points_[static_cast<std::size_t>(input / 3)];
  order.sweep_axis = input % 3;
  started_.run().order(order);
  started_.run().run_for(kGathering_s);
  const double duration_s = 2.0 * kHalfWay_m / kSpeed_m_per_s - kGathering_s - 0.02;
  const int num_sweeps = static_cast<int>(duration_s * rate_hz_ / sweep_ticks_);
  analysis::SweptWay way{.input = input,
                         .commanded_n = Eigen::MatrixXd::Zero(num_inputs(), sweep_ticks_),
                         .velocity_m_per_s = Eigen::MatrixXd::Zero(num_inputs(), sweep_ticks_)};
  Eigen::Index num_ticks = 0;
  started_.run().run_for(num_sweeps * sweep_ticks_ / rate_hz_, [&](const core::Sample& sample) {
    const Eigen::Index tick = num_ticks++ % sweep_ticks_;
    for (int row = 0; row < num_inputs(); ++row) {
      const auto point = static_cast<std::size_t>(points_[static_cast<std::size_t>(row / 3)]);
      const auto axis = static_cast<std::size_t>(row % 3);
      way.commanded_n(row, tick) += sample.tip_force_n[point][axis] / num_sweeps;
      way.velocity_m_per_s(row, tick) += sample.tip_velocity_m_per_s[point][axis] / num_sweeps;
    }
  });
  ways_.push_back(std::move(way));
  order.sweep_n = 0.0;
  started_.run().order(order);
  // The device comes to rest.
  started_.run().run_for(0.3);
}

}  // namespace jnd::app
