#include "false_faults/worn_hand_device.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "device/drawn_mass.h"

namespace jnd::false_faults {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

double between_in_ratio(core::RandomStream& random, double low, double high) {
  return low * std::exp(random.uniform() * std::log(high / low));
}

device::StrokingArm::Parameters relaxed_arm() {
  return {.stiffness_n_per_m = 100.0, .damping_n_s_per_m = 10.0};
}

}  // namespace

Wear Wear::of_person(std::uint64_t seed, std::int64_t person) {
  core::RandomStream random(seed, "wear", {person});
  Wear wear;
  wear.mass_kg = random.uniform(0.6, 2.5);
  wear.stiction_n = random.uniform(0.1, 0.8);
  wear.resolution_m = between_in_ratio(random, 1e-6, 100e-6);
  // The filter is one that a careful author of a driver chooses: one step of an encoder is no
  // more than 3 cm/s.
  wear.filter_hz =
      std::min(between_in_ratio(random, 40.0, 200.0), 0.03 / (kTurn * wear.resolution_m));
  wear.tremor_m = between_in_ratio(random, 20e-6, 500e-6);
  wear.tremor_hz = random.uniform(8.0, 12.0);
  wear.jitter_s = random.uniform(0.0, 200e-6);
  wear.delay_ticks = static_cast<int>(random.below(3));
  return wear;
}

WornHandDevice::WornHandDevice(const Wear& wear, std::uint64_t seed, std::int64_t person)
    : wear_(wear),
      random_(seed, "worn hand", {person}),
      arm_(relaxed_arm(), kPeriod_s),
      filter_ratio_(1.0 - std::exp(-kTurn * wear.filter_hz * kPeriod_s)) {
  sent_.fill(core::zero_vectors());
  state_.attached = core::kAllAttached;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    state_.tip_position_m[i] = position_m_ + device::lumped_hand_tips_m()[i];
  }
  measure();
}

/// Returns a force that shakes a free mass by the amplitude of the tremor, with another phase
/// on each axis.
Eigen::Vector3d WornHandDevice::tremor_n() const noexcept {
  const double turn_rad_per_s = kTurn * wear_.tremor_hz;
  const double force_n = wear_.mass_kg * turn_rad_per_s * turn_rad_per_s * wear_.tremor_m;
  const double phase_rad = turn_rad_per_s * kPeriod_s * static_cast<double>(tick_);
  return force_n * Eigen::Vector3d(std::sin(phase_rad), std::sin(1.07 * phase_rad + 1.0),
                                   std::sin(0.93 * phase_rad + 2.0));
}

/// Moves the mass. Friction holds it exactly at rest, and never reverses its motion (Karnopp
/// 1985).
void WornHandDevice::move(const Eigen::Vector3d& force_n) noexcept {
  velocity_m_per_s_ += kPeriod_s / wear_.mass_kg * force_n;
  const double speed_m_per_s = velocity_m_per_s_.norm();
  const double held_m_per_s = kPeriod_s / wear_.mass_kg * wear_.stiction_n;
  if (speed_m_per_s <= held_m_per_s) {
    velocity_m_per_s_.setZero();
  } else {
    velocity_m_per_s_ *= 1.0 - held_m_per_s / speed_m_per_s;
  }
  position_m_ += kPeriod_s * velocity_m_per_s_;
}

void WornHandDevice::slide_fingers() noexcept {
  const bool one_slips = random_.with_probability(kPeriod_s * wear_.slips_per_s);
  const bool one_comes_off = random_.with_probability(kPeriod_s * wear_.comes_off_per_s);
  if (one_slips || one_comes_off) {
    Finger& finger = fingers_[random_.below(fingers_.size())];
    finger.sliding_ticks = 10 + static_cast<int>(random_.below(40));
    const Eigen::Vector3d to_m(random_.normal(0.0, 0.002), random_.normal(0.0, 0.002),
                               random_.normal(0.0, 0.002));
    finger.slide_m = (to_m - finger.offset_m) / finger.sliding_ticks;
    if (one_comes_off && finger.loose_ticks == 0) {
      finger.loose_ticks = 50 + static_cast<int>(random_.below(450));
      ++num_detachments_;
    }
  }
  for (Finger& finger : fingers_) {
    if (finger.loose_ticks > 0) --finger.loose_ticks;
    if (finger.sliding_ticks == 0) continue;
    --finger.sliding_ticks;
    finger.offset_m += finger.slide_m;
  }
}

/// Measures at a jittered time, on the grid of the encoders. The velocity is that of a driver,
/// which computes it from the last two positions and their times.
void WornHandDevice::measure() noexcept {
  const double late_s = random_.uniform(-wear_.jitter_s, wear_.jitter_s);
  const std::int64_t time_ns =
      1'000'000 * (tick_ + 1) + static_cast<std::int64_t>(std::llround(1e9 * late_s));
  const double elapsed_s = 1e-9 * static_cast<double>(time_ns - state_.device_time_ns);
  state_.device_time_ns = time_ns;
  for (int i = 0; i < core::kNumContactPoints; ++i) {
    const Finger& finger = fingers_[static_cast<std::size_t>(i)];
    const Eigen::Vector3d exact_m = position_m_ + late_s * velocity_m_per_s_ +
                                    device::lumped_hand_tips_m()[i] + finger.offset_m;
    const Eigen::Vector3d seen_m =
        wear_.resolution_m * (exact_m / wear_.resolution_m).array().round().matrix();
    const Eigen::Vector3d raw_m_per_s = (seen_m - state_.tip_position_m[i]) / elapsed_s;
    state_.tip_velocity_m_per_s[i] +=
        filter_ratio_ * (raw_m_per_s - state_.tip_velocity_m_per_s[i]);
    state_.tip_position_m[i] = seen_m;
    state_.attached[i] = finger.loose_ticks == 0;
  }
  state_.end_effector_position_m = position_m_;
}

bool WornHandDevice::read(core::HapticState& state) noexcept {
  // If a measurement is lost, the last one takes its place, and the next one reports the force
  // of both.
  core::HapticState now = state_;
  const bool is_lost = random_.with_probability(wear_.lost_ratio);
  if (!is_lost || !has_delivered_) {
    for (int i = 0; i < core::kNumContactPoints; ++i) {
      now.acted_n[i] = acted_sum_n_[i] / std::max(1, num_acted_);
    }
    acted_sum_n_ = core::zero_vectors();
    num_acted_ = 0;
    last_delivered_ = now;
    has_delivered_ = true;
  }
  state = last_delivered_;
  return true;
}

bool WornHandDevice::write(const core::PointVectors& force_on_hand_n) noexcept {
  const auto slot = [](std::int64_t tick) {
    return static_cast<std::size_t>((tick + kMostDelayTicks) % kMostDelayTicks);
  };
  sent_[slot(tick_)] =
      halt_.withholds(force_on_hand_n) ? core::zero_vectors() : force_on_hand_n;
  const core::PointVectors& acting_n = sent_[slot(tick_ - wear_.delay_ticks)];
  for (int i = 0; i < core::kNumContactPoints; ++i) acted_sum_n_[i] += acting_n[i];
  ++num_acted_;
  arm_.advance();
  move(device::total_of(acting_n) + tremor_n() + arm_.force_n(position_m_, velocity_m_per_s_));
  slide_fingers();
  ++tick_;
  measure();
  return true;
}

}  // namespace jnd::false_faults
