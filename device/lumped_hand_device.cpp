#include "device/lumped_hand_device.h"

#include <cmath>

#include "core/require.h"

namespace jnd::device {
namespace {

using core::require;

double period_of(double rate_hz) {
  require(rate_hz > 0.0 && std::isfinite(rate_hz), "rate_hz", "a finite number > 0", rate_hz);
  return 1.0 / rate_hz;
}

void require_positive(double value, const char* field) {
  require(value > 0.0 && std::isfinite(value), field, "a finite number > 0", value);
}

void require_not_negative(double value, const char* field) {
  require(value >= 0.0 && std::isfinite(value), field, "a finite number >= 0", value);
}

}  // namespace

const core::PointVectors& lumped_hand_tips_m() noexcept {
  // A stiff hand seen from the right: fingers along +y, thumb up; all in the plane x = 0.
  static const core::PointVectors kTips = {
      Eigen::Vector3d(0.0, -0.061, 0.017), Eigen::Vector3d(0.0, -0.061, -0.043),
      Eigen::Vector3d(0.0, -0.001, 0.037), Eigen::Vector3d(0.0, 0.059, 0.007),
      Eigen::Vector3d(0.0, 0.064, -0.018)};
  return kTips;
}

LumpedHandDevice::LumpedHandDevice(const Parameters& parameters)
    : parameters_(parameters),
      period_s_(period_of(parameters.rate_hz)),
      period_ns_(std::llround(1e9 / parameters.rate_hz)),
      arm_(parameters.arm, period_s_),
      position_m_(arm_.reference_m()) {
  require_positive(parameters.mass_kg, "mass_kg");
  require_not_negative(parameters.mechanical_viscosity_n_s_per_m,
                       "mechanical_viscosity_n_s_per_m");
  require_not_negative(parameters.dry_friction_n, "dry_friction_n");
  require_positive(parameters.friction_speed_m_per_s, "friction_speed_m_per_s");
  require_positive(parameters.max_force_per_point_n, "max_force_per_point_n");
  require_positive(parameters.max_total_force_n, "max_total_force_n");
  // Explicit damping is stable below 2 mass / period; half of it is left to the medium.
  const double damping = parameters.mechanical_viscosity_n_s_per_m +
                         parameters.dry_friction_n / parameters.friction_speed_m_per_s +
                         parameters.arm.damping_n_s_per_m;
  require(damping * period_s_ < parameters.mass_kg, "mass_kg",
          "a number > period * (viscosity + friction / friction speed + arm damping)",
          parameters.mass_kg);
}

DeviceCapabilities LumpedHandDevice::capabilities() const noexcept {
  return {.rate_hz = parameters_.rate_hz,
          .max_force_per_point_n = parameters_.max_force_per_point_n,
          .max_total_force_n = parameters_.max_total_force_n,
          .simulated = true};
}

void LumpedHandDevice::open() {
  arm_ = StrokingArm(parameters_.arm, period_s_);
  position_m_ = arm_.reference_m();
  velocity_m_per_s_.setZero();
  device_time_ns_ = 0;
  sums_ = {};
}

bool LumpedHandDevice::read(core::HapticState& state) noexcept {
  const core::PointVectors& tips = lumped_hand_tips_m();
  state.device_time_ns = device_time_ns_;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    state.tip_position_m[i] = position_m_ + tips[i];
    state.tip_velocity_m_per_s[i] = velocity_m_per_s_;
    state.attached[i] = true;
  }
  // The platform that carries the fingers, behind the hand.
  state.end_effector_position_m = position_m_ - Eigen::Vector3d(0.0, 0.12, 0.0);
  return true;
}

bool LumpedHandDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  follow_orders();
  Eigen::Vector3d rendered_n = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& force : force_on_hand_n) rendered_n += force;
  const double squared_m2_per_s2 = velocity_m_per_s_.squaredNorm();
  double damping_n_s_per_m = parameters_.mechanical_viscosity_n_s_per_m;
  if (parameters_.dry_friction_n > 0.0) {
    damping_n_s_per_m += parameters_.dry_friction_n /
                         std::sqrt(squared_m2_per_s2 + parameters_.friction_speed_m_per_s *
                                                           parameters_.friction_speed_m_per_s);
  }

  const double speed_m_per_s = std::sqrt(squared_m2_per_s2);
  const double rendered_opposing_n =
      speed_m_per_s > 0.0 ? -rendered_n.dot(velocity_m_per_s_) / speed_m_per_s : 0.0;
  ++sums_.num_ticks;
  sums_.rendered_opposing_n += rendered_opposing_n;
  sums_.opposing_n += rendered_opposing_n + damping_n_s_per_m * speed_m_per_s;
  sums_.speed_m_per_s += speed_m_per_s;

  arm_.advance();
  const Eigen::Vector3d force_n = rendered_n - damping_n_s_per_m * velocity_m_per_s_ +
                                  arm_.force_n(position_m_, velocity_m_per_s_);
  velocity_m_per_s_ += (period_s_ / parameters_.mass_kg) * force_n;
  position_m_ += period_s_ * velocity_m_per_s_;
  device_time_ns_ += period_ns_;
  report_progress();
  return true;
}

void LumpedHandDevice::begin_strokes(const StrokePlan& plan, const core::RandomStream& random) {
  require_valid(plan);
  give({.stroke = true, .plan = plan, .random = random});
}

void LumpedHandDevice::go_home() noexcept { give({}); }

void LumpedHandDevice::give(const ArmOrder& order) noexcept {
  ArmOrder numbered = order;
  numbered.number = ++last_order_;
  if (order.stroke) last_stroke_order_ = last_order_;
  orders_.publish(numbered);
}

void LumpedHandDevice::follow_orders() noexcept {
  if (!orders_.fetch()) return;
  const ArmOrder& order = orders_.value();
  if (order.stroke) {
    arm_.begin_strokes(order.plan, order.random);
  } else {
    arm_.go_home();
  }
}

void LumpedHandDevice::report_progress() noexcept {
  const std::uint64_t home = arm_.is_home() ? 1 : 0;
  const auto strokes = static_cast<std::uint64_t>(arm_.strokes_finished());
  const std::uint64_t order = orders_.value().number;
  progress_.store(order << 32 | strokes << 1 | home, std::memory_order_relaxed);
}

// An order that the loop has not taken yet has no strokes to show: what is there belongs to the
// order before.
std::int64_t LumpedHandDevice::strokes_finished() const noexcept {
  const std::uint64_t progress = progress_.load(std::memory_order_relaxed);
  const bool in_force = progress >> 32 >= last_stroke_order_;
  return in_force ? static_cast<std::int64_t>((progress & 0xffffffff) >> 1) : 0;
}

bool LumpedHandDevice::is_home() const noexcept {
  const std::uint64_t progress = progress_.load(std::memory_order_relaxed);
  return progress >> 32 == last_order_ && (progress & 1) == 1;
}

}  // namespace jnd::device
