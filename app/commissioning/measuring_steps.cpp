#include "app/commissioning/measuring_steps.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "app/commissioning/guided_run.h"
#include "core/error.h"
#include "core/random_stream.h"

namespace jnd::app {
namespace {

using analysis::GuidedWay;
using Order = device::MotionGuide::Order;

constexpr double kGravity_m_per_s2 = 9.80665;

Eigen::Vector3d vector_of(const core::PlainVector& plain) {
  return {plain[0], plain[1], plain[2]};
}

std::array<double, 3> plain_of(const Eigen::Vector3d& vector) {
  return {vector.x(), vector.y(), vector.z()};
}

/// Mean of the points that the device has.
Eigen::Vector3d hand_m(const core::Sample& sample, const device::DeviceCapabilities& can) {
  Eigen::Vector3d sum_m = Eigen::Vector3d::Zero();
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (can.has_point(i))
      sum_m += vector_of(sample.tip_position_m[static_cast<std::size_t>(i)]);
  }
  return sum_m / can.num_contact_points();
}

Eigen::Vector3d commanded_n(const core::Sample& sample) {
  Eigen::Vector3d sum_n = Eigen::Vector3d::Zero();
  for (const core::PlainVector& force_n : sample.tip_force_n) sum_n += vector_of(force_n);
  return sum_n;
}

int first_point(const device::DeviceCapabilities& can) {
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    if (can.has_point(i)) return i;
  }
  throw core::Error("commission: expected a device with a contact point, found none");
}

/// A device without a hand and its loop. Nothing moves it before `hold`.
class Started {
 public:
  Started(device::HapticDevice& device, device::Bench& bench, const MeasuringPlan& plan)
      : bench_(bench),
        can_(device.capabilities()),
        run_(device, {.rate_hz = plan.rate_hz,
                      .allow_no_realtime = plan.allow_no_realtime,
                      .emergency_stop = plan.emergency_stop}) {
    run_.while_asking([&bench] {
      bench.take_hand_out();
      bench.clamp();
    });
  }

  [[nodiscard]] GuidedRun& run() noexcept { return run_; }
  [[nodiscard]] const device::DeviceCapabilities& can() const noexcept { return can_; }

  [[nodiscard]] Eigen::Vector3d place_m() {
    Eigen::Vector3d last_m = Eigen::Vector3d::Zero();
    run_.run_for(0.02, [&](const core::Sample& sample) { last_m = hand_m(sample, can_); });
    return last_m;
  }

  /// Holds it where it is by its own force, and is then let go.
  void hold(Order order) {
    run_.arm();
    order.to_m = plain_of(place_m());
    run_.order(order);
    run_.run_for(0.2);
    run_.while_asking([this] { bench_.let_go(); });
    run_.run_for(1.0);
  }

  /// Somebody does this at it: it is held meanwhile and has no force.
  void act(const std::function<void()>& act) {
    run_.while_asking([this] { bench_.clamp(); });
    run_.without_force(act);
    run_.while_asking([this] { bench_.let_go(); });
    run_.run_for(1.0);
  }

  /// Goes there and waits until it is there.
  void go_to(const Eigen::Vector3d& place_m, Order order) {
    constexpr double kPace_m_per_s = 0.2;
    const double way_m = (this->place_m() - place_m).norm();
    order.to_m = plain_of(place_m);
    order.speed_m_per_s = kPace_m_per_s;
    run_.order(order);
    run_.run_for(way_m / kPace_m_per_s + 0.5);
  }

 private:
  device::Bench& bench_;
  device::DeviceCapabilities can_;
  GuidedRun run_;
};

/// A critically damped hold of a device of this mass, in newtons commanded.
Order holding(double mass_per_gain_kg) {
  constexpr double kRate_rad_per_s = 20.0;
  return {.stiffness_n_per_m = kRate_rad_per_s * kRate_rad_per_s * mass_per_gain_kg,
          .damping_n_s_per_m = 2.0 * kRate_rad_per_s * mass_per_gain_kg,
          .is_on = true};
}

/// Before anything is known of it: soft enough for whatever it is.
constexpr Order kSoftHold = {
    .stiffness_n_per_m = 40.0, .damping_n_s_per_m = 3.0, .is_on = true};

/// What the ways of one load are made with.
struct WaySetting {
  double load_kg = 0.0;
  int pose = 0;
};

/// Along a line, about a middle that is drawn anew for each, so that cogging averages out.
class Ways {
 public:
  Ways(Started& started, const MeasuringPlan& plan, const analysis::DelayFit& roughly)
      : started_(started),
        period_s_(1.0 / plan.rate_hz),
        order_(holding(roughly.mass_per_gain_kg.value)),
        // A force stands for a tick, so it acts half a tick later on the whole.
        delay_ticks_(0.5 + std::max(0.0, roughly.delay_s.value) * plan.rate_hz),
        random_(plan.seed, "commissioning ways") {}

  void go(const Eigen::Vector3d& middle_m, const Eigen::Vector3d& direction, double half_way_m,
          double speed_m_per_s, const WaySetting& setting) {
    const Eigen::Vector3d shifted_m = middle_m + random_.uniform(-0.015, 0.015) * direction;
    started_.go_to(shifted_m - half_way_m * direction, order_);
    for (const double sense : {1.0, -1.0}) {
      one_way(shifted_m + sense * half_way_m * direction, sense * direction, half_way_m,
              speed_m_per_s, setting);
    }
  }

  [[nodiscard]] const std::vector<GuidedWay>& ways() const noexcept { return ways_; }

 private:
  void one_way(const Eigen::Vector3d& end_m, const Eigen::Vector3d& along, double half_way_m,
               double speed_m_per_s, const WaySetting& setting) {
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

  /// As it acted, at the time of each position.
  [[nodiscard]] std::vector<double> delayed(const std::vector<double>& force_n) const {
    const auto whole = static_cast<std::size_t>(delay_ticks_);
    const double part = delay_ticks_ - static_cast<double>(whole);
    std::vector<double> acting_n(force_n.size(), 0.0);
    for (std::size_t i = whole + 1; i < force_n.size(); ++i) {
      acting_n[i] = (1.0 - part) * force_n[i - whole] + part * force_n[i - whole - 1];
    }
    return acting_n;
  }

  Started& started_;
  double period_s_;
  Order order_;
  double delay_ticks_;
  core::RandomStream random_;
  std::vector<GuidedWay> ways_;
};

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
  Started started(device, bench, plan);
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
  Started started(device, bench, plan);
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

namespace {

/// Pushes to and fro along the device's x while it moves on, so that friction never turns.
class Pushes {
 public:
  Pushes(Started& started, const MeasuringPlan& plan)
      : started_(started),
        period_s_(1.0 / plan.rate_hz),
        push_ticks_(2 * static_cast<int>(std::lround(0.5 * kPush_s * plan.rate_hz))),
        random_(plan.seed, "commissioning pushes") {}

  /// One way there and one back.
  void go(const Eigen::Vector3d& middle_m, int num_rounds,
          const std::function<void(int)>& tell) {
    for (int round = 0; round < num_rounds; ++round) {
      tell(round);
      Order order = kFirmHold;
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

  [[nodiscard]] analysis::DelayFit fit(double damping_per_gain) const {
    return analysis::fit_delay(windows_, period_s_, push_ticks_, damping_per_gain);
  }

 private:
  void take_windows(double sense) {
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
      // A light device turned back: softer, and these windows tell nothing.
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

  static constexpr double kPush_s = 0.030, kHalfWay_m = 0.14, kSpeed_m_per_s = 0.15,
                          kGathering_s = 0.6;
  static constexpr Order kFirmHold = {
      .stiffness_n_per_m = 100.0, .damping_n_s_per_m = 10.0, .is_on = true};

  Started& started_;
  double period_s_;
  int push_ticks_;
  core::RandomStream random_;  ///< Of where it goes, so that cogging averages out.
  int num_ways_ = 0;
  double push_n_ = 3.0;
  std::vector<analysis::PushedWindow> windows_;
};

}  // namespace

analysis::DelayFit measure_delay(device::HapticDevice& device, device::Bench& bench,
                                 const MeasuringPlan& plan, const analysis::ForceFit& force,
                                 const StepProgress& progress) {
  constexpr int kRounds = 12;
  Started started(device, bench, plan);
  started.hold(kSoftHold);
  Pushes pushes(started, plan);
  pushes.go(started.place_m(), kRounds, [&](int round) {
    progress(static_cast<double>(round) / kRounds,
             "The device is pushed to and fro as it moves.");
  });
  started.run().stop();
  progress(1.0, "");
  return pushes.fit(force.damping_n_s_per_m.value / force.gain.value);
}

analysis::ForceFit measure_force(device::HapticDevice& device, device::Bench& bench,
                                 const MeasuringPlan& plan, const analysis::FrameFit& frame,
                                 const StepProgress& progress) {
  constexpr std::array kSpeeds_m_per_s = {0.05, 0.1, 0.2, 0.3};
  constexpr std::array kLoadedSpeeds_m_per_s = {0.05, 0.15};
  constexpr std::array kHeights_m = {-0.04, 0.0, 0.04};
  constexpr double kHalfWay_m = 0.08, kLoadedHalfWay_m = 0.05;
  constexpr int kRounds = 2;

  Started started(device, bench, plan);
  started.hold(kSoftHold);
  const Eigen::Vector3d home_m = started.place_m();
  // How heavy and how late it is, roughly, for whoever guides it.
  Pushes pushes(started, plan);
  pushes.go(home_m, 3, [&](int) { progress(0.0, "The device is pushed to and fro."); });
  // Along the axes of the workspace, as the device has them.
  const Eigen::Matrix3d to_device = frame.rotation.transpose();
  const Eigen::Vector3d up = to_device.col(2);
  const analysis::DelayFit roughly = pushes.fit(0.0);
  Ways ways(started, plan, roughly);
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
