#include "analysis/movement/force_by_speed.h"

#include <algorithm>
#include <cmath>

#include "core/error.h"
#include "experiments/procedures/stimulus.h"

namespace jnd::analysis {
namespace {

constexpr double kClassWidthMPerS = 0.02;
// The classes reach up to 2 m/s. Faster ticks join the last one.
constexpr std::size_t kNumClasses = 100;
constexpr double kMinTicks = 20.0;

std::optional<core::MediumAmounts> known_amounts(const std::string& medium, double intensity) {
  if (!(intensity >= 0.0) || !std::isfinite(intensity)) return std::nullopt;
  try {
    const core::MediumAmounts amounts = experiments::amounts_of(medium, intensity);
    if (amounts.is_drag_of_motion()) return amounts;
  } catch (const core::Error&) {
    // This version does not know the medium.
  }
  return std::nullopt;
}

}  // namespace

CommandedForce::CommandedForce(const std::string& medium, double intensity,
                               std::optional<double> damping_n_s_per_m) {
  if (damping_n_s_per_m) {
    amounts_ = core::MediumAmounts{.damping_n_s_per_m = *damping_n_s_per_m};
  } else {
    amounts_ = known_amounts(medium, intensity);
  }
  is_plain_damping_ = amounts_ && amounts_->is_plain_damping();
}

double CommandedForce::opposing_n(const core::Sample& sample, double speed_m_per_s) const {
  if (!amounts_) return 0.0;
  if (is_plain_damping_) return amounts_->damping_n_s_per_m * speed_m_per_s;
  core::PointVectors position_m, velocity_m_per_s;
  // Points that the device does not have lie at zero and do not count.
  const std::uint8_t bits = core::measured_bits(sample);
  std::array<bool, core::kNumContactPoints> is_there{};
  for (std::size_t i = 0; i < position_m.size(); ++i) {
    is_there[i] = bits == 0 || (bits >> i & 1) != 0;
    position_m[i] = Eigen::Vector3d::Map(sample.tip_position_m[i].data());
    velocity_m_per_s[i] = Eigen::Vector3d::Map(sample.tip_velocity_m_per_s[i].data());
  }
  core::HandMotion motion = core::hand_motion(position_m, velocity_m_per_s, is_there);
  // Without a hand plane the hand meets the fluid head on, as in the force loop.
  if (!core::tip_of_hand_plane(is_there)) motion.sin_angle_of_attack = 1.0;
  return amounts_->drag_n(motion);
}

void ForceSums::Sums::add(const Sums& other) noexcept {
  num_ticks += other.num_ticks;
  speed_m_per_s += other.speed_m_per_s;
  delivered_n += other.delivered_n;
  commanded_n += other.commanded_n;
}

void ForceSums::add(double speed_m_per_s, double delivered_n, double commanded_n) noexcept {
  if (classes_.empty()) classes_.resize(kNumClasses);
  const Sums tick = {1.0, speed_m_per_s, delivered_n, commanded_n};
  all_.add(tick);
  const double place =
      std::min(speed_m_per_s / kClassWidthMPerS, static_cast<double>(kNumClasses - 1));
  classes_[static_cast<std::size_t>(place)].add(tick);
}

void ForceSums::add(const ForceSums& other) noexcept {
  commanded_known_ = commanded_known_ && other.commanded_known_;
  is_measured_ = is_measured_ || other.is_measured_;
  if (other.classes_.empty()) return;
  if (classes_.empty()) classes_.resize(kNumClasses);
  all_.add(other.all_);
  for (std::size_t i = 0; i < kNumClasses; ++i) classes_[i].add(other.classes_[i]);
}

DeliveredForce ForceSums::delivered() const noexcept {
  DeliveredForce force{.is_measured = is_measured_};
  if (!(all_.num_ticks > 0.0)) return force;
  force.delivered_n = all_.delivered_n / all_.num_ticks;
  if (all_.speed_m_per_s > 0.0) {
    force.delivered_damping_n_s_per_m = all_.delivered_n / all_.speed_m_per_s;
  }
  if (!commanded_known_) return force;
  force.commanded_n = all_.commanded_n / all_.num_ticks;
  if (all_.commanded_n > 0.0) force.delivered_ratio = all_.delivered_n / all_.commanded_n;
  return force;
}

ForceBySpeed ForceSums::by_speed() const {
  ForceBySpeed force{.is_measured = is_measured_};
  for (const Sums& one : classes_) {
    if (one.num_ticks < kMinTicks) continue;
    force.speed_m_per_s.push_back(one.speed_m_per_s / one.num_ticks);
    force.delivered_n.push_back(one.delivered_n / one.num_ticks);
    if (commanded_known_) force.commanded_n.push_back(one.commanded_n / one.num_ticks);
  }
  return force;
}

}  // namespace jnd::analysis
