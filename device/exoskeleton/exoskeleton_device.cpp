#include "device/exoskeleton/exoskeleton_device.h"

#include <algorithm>
#include <cmath>

#include "core/require.h"
#include "device/drawn_mass.h"
#include "device/exoskeleton/guiding.h"

namespace jnd::device {
namespace {

double period_of(double rate_hz) {
  // Beyond these rates the simulation diverges or becomes very slow, because the magnets are
  // stiff within a few steps.
  core::require(rate_hz >= 100.0 && rate_hz <= 10000.0, "rate_hz", "a number in [100, 10000]",
                rate_hz);
  return 1.0 / rate_hz;
}

int delay_ticks_of(double delay_s, double rate_hz, int max_ticks) {
  core::require(delay_s >= 0.0 && delay_s <= 0.02, "extra_delay_s", "a number in [0, 0.02]",
                delay_s);
  const auto ticks = static_cast<int>(std::lround(delay_s * rate_hz));
  core::require(ticks < max_ticks, "extra_delay_s", "fewer ticks than the delay line holds",
                delay_s);
  return ticks;
}

}  // namespace

ExoskeletonDevice::ExoskeletonDevice(const Parameters& parameters)
    : parameters_(parameters),
      period_s_(period_of(parameters.rate_hz)),
      period_ns_(std::llround(1e9 / parameters.rate_hz)),
      delay_ticks_(
          delay_ticks_of(parameters.extra_delay_s, parameters.rate_hz, kMaxDelayTicks)),
      arm_(parameters.arm, period_s_),
      kinematics_(arm_.arm().reference_m()),
      world_({.period_s = period_s_,
              .home_m = arm_.arm().reference_m(),
              .base_m = kinematics_.base_position_m(),
              .arm_joint_locked = parameters.arm_joint_locked,
              .attached = parameters.attached,
              .break_away_n = parameters.break_away_n,
              .sensor_seed = parameters.sensor_seed}),
      control_(parameters.control, period_s_),
      filter_(parameters.velocity_cutoff_hz, period_s_) {
  core::require_positive(parameters.max_force_per_point_n, "max_force_per_point_n");
  core::require_positive(parameters.max_total_force_n, "max_total_force_n");
  open();
}

DeviceCapabilities ExoskeletonDevice::capabilities() const noexcept {
  return {.rate_hz = parameters_.rate_hz,
          .max_force_per_point_n = parameters_.max_force_per_point_n,
          .max_total_force_n = parameters_.max_total_force_n,
          .watchdog_timeout_s = 0.250,
          .simulated = true,
          .num_joints = core::kNumJoints,
          .tells_acting_force = true,
          .moves_by_itself = true};
}

void ExoskeletonDevice::open() {
  arm_.reset();
  bench_.reset();
  last_hold_ = 0;
  world_.reset();
  control_.reset();
  filter_.start(world_.encoder_position_rad());
  halt_.reset();
  delay_line_.fill(core::zero_vectors());
  delay_slot_ = 0;
  acted_n_ = core::zero_vectors();
  device_time_ns_ = 0;
  sums_ = {};
  measure();
}

/// Computes everything that a tick knows about the robot.
void ExoskeletonDevice::measure() noexcept {
  measured_.position_rad = world_.encoder_position_rad();
  measured_.velocity_rad_per_s = filter_.update(measured_.position_rad);
  measured_.torque_n_m = world_.sensor_torque_n_m();
  kinematics_.update(measured_.position_rad);
  tip_velocity_m_per_s_ = kinematics_.tip_velocity_m_per_s(measured_.velocity_rad_per_s);
}

bool ExoskeletonDevice::read(core::HapticState& state) noexcept {
  if (!world_.is_valid()) return false;
  state.device_time_ns = device_time_ns_;
  state.tip_position_m = kinematics_.tip_position_m();
  state.tip_velocity_m_per_s = tip_velocity_m_per_s_;
  state.attached = world_.attached();
  state.acted_n = acted_n_;
  state.end_effector_position_m = kinematics_.end_effector_position_m();
  for (int joint = 0; joint < core::kNumJoints; ++joint) {
    state.joint_position_rad[joint] = measured_.position_rad[joint];
    state.joint_torque_n_m[joint] = measured_.torque_n_m[joint];
  }
  return true;
}

bool ExoskeletonDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  const bool nothing_asked =
      std::all_of(force_on_hand_n.begin(), force_on_hand_n.end(),
                  [](const Eigen::Vector3d& force_n) { return force_n.isZero(0.0); });
  if (nothing_asked) control_.rearm();
  if (halt_.withholds(force_on_hand_n)) delay_line_.fill(core::zero_vectors());
  arm_.follow_orders();
  if (arm_.takes_putting_back()) {
    for (int point = 0; point < core::kNumContactPoints; ++point) world_.attach(point);
  }
  // A number that is not finite must not enter the delay line.
  core::PointVectors given_n = std::isfinite(total_of(force_on_hand_n).sum())
                                   ? delayed(within_capabilities(force_on_hand_n))
                                   : force_on_hand_n;
  JointVector torque_n_m = control_.torque_n_m(kinematics_, measured_, given_n);
  if (control_.fault() != core::Fault::kNone) delay_line_.fill(core::zero_vectors());
  // If the device was halted in the middle of this, the force ends, but the robot's weight is
  // still held.
  if (halt_.is_halted()) {
    torque_n_m = kinematics_.gravity_torque_n_m();
    given_n = core::zero_vectors();
  }

  arm_.advance();
  const bool stepped = world_.step(torque_n_m, pull_on_forearm_n());
  acted_n_ = control_.fault() == core::Fault::kNone ? given_n : core::zero_vectors();
  device_time_ns_ += period_ns_;
  if (!stepped) return false;
  if (control_.fault() == core::Fault::kNone) add_to_sums(given_n);
  measure();
  return control_.fault() == core::Fault::kNone;
}

/// Returns the pull of whoever is at the hand: the person, or somebody who holds a dummy.
Eigen::Vector3d ExoskeletonDevice::pull_on_forearm_n() noexcept {
  const BenchState& done = bench_.newest();
  const Eigen::Vector3d& hand_m = world_.hand_position_m();
  const Eigen::Vector3d& velocity_m_per_s = world_.hand_velocity_m_per_s();
  if (done.has_hand) return arm_.arm().force_n(hand_m, velocity_m_per_s);
  constexpr double kGravity_m_per_s2 = 9.80665;
  constexpr Guiding kHolding = {.stiffness = 3000.0, .damping = 150.0, .strength = 60.0};
  Eigen::Vector3d pull_n(0.0, 0.0, -kGravity_m_per_s2 * done.load_kg);
  if (!done.is_clamped && !done.is_touching) return pull_n;
  if (done.num_holds != last_hold_) held_m_ = hand_m;
  last_hold_ = done.num_holds;
  if (done.is_touching) {
    constexpr double kCarrying_m_per_s = 0.2;
    const Eigen::Vector3d mark_m(done.mark_m[0], done.mark_m[1], done.mark_m[2]);
    const Eigen::Vector3d way_m = mark_m - kinematics_.tip_position_m().front();
    // The motion slows down near the mark, because the arm lags behind.
    constexpr double kSlowing_per_s = 5.0;
    const double way_now_m =
        period_s_ * std::min(kSlowing_per_s * way_m.norm(), kCarrying_m_per_s);
    if (way_now_m > 0.0) held_m_ += way_m.normalized() * way_now_m;
  }
  return pull_n + kHolding.effort(held_m_ - hand_m, velocity_m_per_s);
}

/// The writer may have no limiter, so the device keeps to its own capabilities.
core::PointVectors ExoskeletonDevice::within_capabilities(
    const core::PointVectors& force_n) const noexcept {
  core::PointVectors within_n = force_n;
  double sum_n = 0.0;
  for (Eigen::Vector3d& force : within_n) {
    const double magnitude_n = force.norm();
    if (magnitude_n > parameters_.max_force_per_point_n) {
      force *= parameters_.max_force_per_point_n / magnitude_n;
    }
    sum_n += std::min(magnitude_n, parameters_.max_force_per_point_n);
  }
  if (sum_n > parameters_.max_total_force_n) {
    for (Eigen::Vector3d& force : within_n) force *= parameters_.max_total_force_n / sum_n;
  }
  return within_n;
}

const core::PointVectors& ExoskeletonDevice::delayed(
    const core::PointVectors& force_n) noexcept {
  const int slot = delay_slot_;
  delay_line_[slot] = force_n;
  delay_slot_ = (slot + 1) % kMaxDelayTicks;
  return delay_line_[(slot + kMaxDelayTicks - delay_ticks_) % kMaxDelayTicks];
}

void ExoskeletonDevice::add_to_sums(const core::PointVectors& force_on_hand_n) noexcept {
  const Eigen::Vector3d& velocity_m_per_s = world_.hand_velocity_m_per_s();
  const double speed_m_per_s = velocity_m_per_s.norm();
  ++sums_.num_ticks;
  sums_.speed_m_per_s += speed_m_per_s;
  if (!(speed_m_per_s > 0.0)) return;
  const Eigen::Vector3d against = -velocity_m_per_s / speed_m_per_s;
  sums_.rendered_opposing_n += against.dot(total_of(force_on_hand_n));
  sums_.opposing_n += against.dot(total_of(world_.magnet_force_on_hand_n()));
}

core::Fault ExoskeletonDevice::fault() const noexcept {
  return world_.is_valid() ? control_.fault() : core::Fault::kSimulationInvalid;
}

}  // namespace jnd::device
