#include "device/stroking_arm.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/require.h"

namespace jnd::device {
namespace {

using core::require;
using core::require_not_negative;
using core::require_positive;

struct Range {
  double StrokePlan::*value;
  const char* field;
  double lowest, highest;
  const char* words;

  /// False for NaN.
  [[nodiscard]] bool contains(double number) const noexcept {
    return number >= lowest && number <= highest;
  }
};

constexpr std::array kRanges = {
    Range{&StrokePlan::amplitude_m, "amplitude_m", 0.001, 2.0, "a number in [0.001, 2]"},
    Range{&StrokePlan::max_speed_m_per_s, "max_speed_m_per_s", 0.001, 5.0,
          "a number in [0.001, 5]"},
    Range{&StrokePlan::height_m, "height_m", -5.0, 5.0, "a number in [-5, 5]"},
    Range{&StrokePlan::lift_m, "lift_m", -1.0, 1.0, "a number in [-1, 1]"},
    Range{&StrokePlan::amplitude_sd_ratio, "amplitude_sd_ratio", 0.0, 0.3,
          "a number in [0, 0.3]"},
    Range{&StrokePlan::speed_sd_ratio, "speed_sd_ratio", 0.0, 0.3, "a number in [0, 0.3]"},
    Range{&StrokePlan::height_sd_m, "height_sd_m", 0.0, 0.5, "a number in [0, 0.5]"},
    Range{&StrokePlan::sideways_sd_m, "sideways_sd_m", 0.0, 0.5, "a number in [0, 0.5]"},
};

bool is_possible(std::int64_t num_strokes) noexcept {
  return num_strokes >= 0 && num_strokes <= 1'000'000;
}

double clipped_normal(core::RandomStream& random) noexcept {
  // With the largest allowed spread, 0.3, no factor 1 + sd z comes close to zero.
  return std::clamp(random.normal(), -2.5, 2.5);
}

}  // namespace

void require_valid(const StrokePlan& plan) {
  for (const Range& range : kRanges) {
    const double value = plan.*range.value;
    require(range.contains(value), range.field, range.words, value);
  }
  require(is_possible(plan.num_strokes), "num_strokes", "a number in [0, 1000000]",
          static_cast<double>(plan.num_strokes));
}

bool is_valid(const StrokePlan& plan) noexcept {
  return is_possible(plan.num_strokes) &&
         std::all_of(kRanges.begin(), kRanges.end(),
                     [&plan](const Range& range) { return range.contains(plan.*range.value); });
}

StrokingArm::StrokingArm(const Parameters& parameters, double period_s)
    : parameters_(parameters),
      period_s_(period_s),
      reference_m_(parameters.home_x_m, parameters.home_y_m, parameters.home_z_m) {
  curve_.fill(Eigen::Vector3d::Zero());
  require_not_negative(parameters.stiffness_n_per_m, "stiffness_n_per_m");
  require_not_negative(parameters.damping_n_s_per_m, "damping_n_s_per_m");
  require(reference_m_.allFinite(), "home", "finite numbers", reference_m_.sum());
  require_positive(parameters.home_s, "home_s");
  require_positive(period_s, "period_s");
}

void StrokingArm::begin_strokes(const StrokePlan& plan,
                                const core::RandomStream& random) noexcept {
  plan_ = plan;
  random_ = random;
  strokes_finished_ = 0;
  draw_stroke();
  // From rest to rest, a cubic's top speed is 1.5 distance / duration, which is about that of
  // the stroke.
  const double distance_m = (near_end_m_ - reference_m_).norm();
  start_curve(Phase::kApproaching, near_end_m_,
              std::max(0.1, 0.5 * std::numbers::pi * distance_m / speed_m_per_s_));
}

void StrokingArm::go_home() noexcept {
  if (phase_ == Phase::kHome) return;
  start_curve(Phase::kGoingHome,
              {parameters_.home_x_m, parameters_.home_y_m, parameters_.home_z_m},
              parameters_.home_s);
}

void StrokingArm::advance() noexcept {
  switch (phase_) {
    case Phase::kHome:
      return;
    case Phase::kGoingHome:
    case Phase::kApproaching:
      advance_curve();
      break;
    case Phase::kForward:
    case Phase::kBack:
      advance_half_stroke();
      break;
  }
  if (ticks_left_ == 0) turn();
}

void StrokingArm::start_curve(Phase phase, const Eigen::Vector3d& to_m,
                              double duration_s) noexcept {
  phase_ = phase;
  ticks_left_ = std::max<std::int64_t>(1, std::llround(duration_s / period_s_));
  curve_step_ratio_ = 1.0 / static_cast<double>(ticks_left_);
  curve_ratio_ = 0.0;
  half_end_m_ = to_m;
  // This is Hermite's cubic.
  const Eigen::Vector3d start_slope_m =
      (static_cast<double>(ticks_left_) * period_s_) * reference_velocity_m_per_s_;
  const Eigen::Vector3d way_m = to_m - reference_m_;
  curve_[0] = reference_m_;
  curve_[1] = start_slope_m;
  curve_[2] = 3.0 * way_m - 2.0 * start_slope_m;
  curve_[3] = start_slope_m - 2.0 * way_m;
}

void StrokingArm::advance_curve() noexcept {
  curve_ratio_ += curve_step_ratio_;
  const double u = curve_ratio_;
  reference_m_ = curve_[0] + u * (curve_[1] + u * (curve_[2] + u * curve_[3]));
  reference_velocity_m_per_s_ = (curve_step_ratio_ / period_s_) *
                                (curve_[1] + u * (2.0 * curve_[2] + 3.0 * u * curve_[3]));
  --ticks_left_;
}

void StrokingArm::draw_stroke() noexcept {
  const double amplitude_m =
      plan_.amplitude_m * (1.0 + plan_.amplitude_sd_ratio * clipped_normal(random_));
  speed_m_per_s_ =
      plan_.max_speed_m_per_s * (1.0 + plan_.speed_sd_ratio * clipped_normal(random_));
  const double height_m = plan_.height_m + plan_.height_sd_m * clipped_normal(random_);
  const double far_y_m = parameters_.home_y_m + plan_.sideways_sd_m * clipped_normal(random_);
  const double near_y_m = parameters_.home_y_m + plan_.sideways_sd_m * clipped_normal(random_);
  far_end_m_ = {parameters_.home_x_m + amplitude_m, far_y_m, height_m};
  near_end_m_ = {parameters_.home_x_m - amplitude_m, near_y_m, height_m};
}

void StrokingArm::start_half_stroke(Phase phase, const Eigen::Vector3d& to_m) noexcept {
  phase_ = phase;
  half_start_m_ = reference_m_;
  half_end_m_ = to_m;
  const double half_width_m = 0.5 * std::abs(to_m.x() - reference_m_.x());
  ticks_left_ = std::max<std::int64_t>(
      2, std::llround(std::numbers::pi * half_width_m / (speed_m_per_s_ * period_s_)));
  const double step_rad = std::numbers::pi / static_cast<double>(ticks_left_);
  angular_speed_rad_per_s_ = step_rad / period_s_;
  cosine_ = 1.0;
  sine_ = 0.0;
  step_cosine_ = std::cos(step_rad);
  step_sine_ = std::sin(step_rad);
}

void StrokingArm::advance_half_stroke() noexcept {
  const double cosine = cosine_ * step_cosine_ - sine_ * step_sine_;
  sine_ = sine_ * step_cosine_ + cosine_ * step_sine_;
  cosine_ = cosine;
  const Eigen::Vector3d way_m = half_end_m_ - half_start_m_;
  reference_m_ = half_start_m_ + (0.5 * (1.0 - cosine_)) * way_m;
  reference_velocity_m_per_s_ = (0.5 * sine_ * angular_speed_rad_per_s_) * way_m;
  // The squared sine starts and ends with slope 0, so that the turn is smooth in z, too.
  const double lift_m = phase_ == Phase::kForward ? -plan_.lift_m : plan_.lift_m;
  reference_m_.z() += lift_m * sine_ * sine_;
  reference_velocity_m_per_s_.z() += 2.0 * lift_m * sine_ * cosine_ * angular_speed_rad_per_s_;
  --ticks_left_;
}

void StrokingArm::turn() noexcept {
  // Every stroke starts exactly at its end point, so that rounding does not accumulate over
  // strokes.
  reference_m_ = half_end_m_;
  reference_velocity_m_per_s_.setZero();
  switch (phase_) {
    case Phase::kHome:
      break;
    case Phase::kGoingHome:
      phase_ = Phase::kHome;
      break;
    case Phase::kApproaching:
      start_half_stroke(Phase::kForward, far_end_m_);
      break;
    case Phase::kForward:
      start_half_stroke(Phase::kBack, near_end_m_);
      break;
    case Phase::kBack:
      ++strokes_finished_;
      if (plan_.num_strokes > 0 && strokes_finished_ >= plan_.num_strokes) {
        go_home();
      } else {
        draw_stroke();
        start_half_stroke(Phase::kForward, far_end_m_);
      }
      break;
  }
}

}  // namespace jnd::device
