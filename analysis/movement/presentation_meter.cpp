#include "analysis/movement/presentation_meter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analysis/movement/strokes.h"

namespace jnd::analysis {
namespace {

/// Longer strokes are not normalised. At most this much of a presentation is kept.
constexpr double kLongestStrokeS = 30.0;
/// The end of a stroke may be joined to its beginning if their distance is at most this share
/// of its width.
constexpr double kMostOpenRatio = 0.2;

double open_m(const HalfStroke& there, const HalfStroke& back) noexcept {
  return std::hypot(back.to_x_m - there.from_x_m, back.to_y_m - there.from_y_m);
}

}  // namespace

void MovementSums::add(const MovementSums& other) {
  strokes.add(other.strokes);
  curves.add(other.curves);
  force.add(other.force);
  height_m += other.height_m;
  num_ticks += other.num_ticks;
}

HandTick hand_tick(const core::Sample& sample, const std::array<double, 2>& forward) noexcept {
  const double share = 1.0 / core::num_measured_points(sample);
  HandTick hand{.tick = sample.tick};
  core::PlainVector velocity_m_per_s{}, force_n{};
  for (int point = 0; point < core::kNumContactPoints; ++point) {
    const core::PlainVector& position = sample.tip_position_m[point];
    const core::PlainVector& velocity = sample.tip_velocity_m_per_s[point];
    const core::PlainVector& force = core::delivered_force_n(sample)[point];
    hand.x_m += position[0];
    hand.y_m += position[1];
    hand.z_m += position[2];
    for (int axis = 0; axis < 3; ++axis) {
      velocity_m_per_s[axis] += velocity[axis];
      force_n[axis] += force[axis];
      hand.dissipated_w -= force[axis] * velocity[axis];
    }
  }
  hand.x_m *= share;
  hand.y_m *= share;
  hand.z_m *= share;
  const double x = share * velocity_m_per_s[0], y = share * velocity_m_per_s[1],
               z = share * velocity_m_per_s[2];
  hand.speed_m_per_s = std::sqrt(x * x + y * y + z * z);
  hand.forward_velocity_m_per_s = x * forward[0] + y * forward[1];
  if (hand.speed_m_per_s > 0.0) {
    hand.opposing_force_n =
        -(force_n[0] * x + force_n[1] * y + force_n[2] * z) / hand.speed_m_per_s;
  }
  return hand;
}

PresentationMeter::PresentationMeter(const Parameters& parameters)
    : parameters_(parameters),
      finder_(parameters.strokes),
      buffer_(static_cast<std::size_t>(kLongestStrokeS / parameters.strokes.period_s),
              parameters.has_joints) {}

void PresentationMeter::begin(const PresentationMovement& presentation,
                              const CommandedForce& commanded) {
  end_stretch();
  result_ = {.movement = presentation};
  commanded_ = commanded;
  if (!commanded.is_known()) result_.sums.force.commanded_is_unknown();
  last_tick_ = presentation.first_tick - 1;
  first_sample_ = true;
}

bool PresentationMeter::feed(const core::Sample& sample) {
  if (sample.tick <= last_tick_) return false;
  const HandTick hand = hand_tick(sample, parameters_.forward);
  // A sum is finite only if every term is finite.
  if (!std::isfinite(hand.x_m + hand.y_m + hand.z_m + hand.speed_m_per_s + hand.dissipated_w)) {
    return false;
  }
  if (sample.tick > last_tick_ + 1) {
    result_.movement.marks.missing_ticks += sample.tick - last_tick_ - 1;
    end_stretch();
  }
  last_tick_ = sample.tick;
  hand_ = hand;
  mark(sample);
  if (sample.tick < result_.movement.first_tick + parameters_.ramp_ticks) return true;
  result_.sums.height_m += hand_.z_m;
  ++result_.sums.num_ticks;
  result_.sums.force.add(hand_.speed_m_per_s, hand_.opposing_force_n,
                         commanded_.opposing_n(sample, hand_.speed_m_per_s));
  if (sample.channels.has(core::kMeasuredForce)) result_.sums.force.is_measured();
  buffer_.push(hand_, sample);
  if (const std::optional<HalfStroke> half = finder_.feed(hand_)) take_half(*half);
  return true;
}

void PresentationMeter::mark(const core::Sample& sample) noexcept {
  if (first_sample_) {
    held_bits_ = static_cast<std::uint8_t>(held_bits_ | sample.attached_bits);
    first_sample_ = false;
  }
  const bool lost = (held_bits_ & ~sample.attached_bits) != 0;
  const bool at_fault = sample.fault != 0;
  MovementMarks& marks = result_.movement.marks;
  marks.lost_contact_ticks += std::int64_t{lost};
  marks.fault_ticks += std::int64_t{at_fault};
  marks.limited_ticks += std::int64_t{sample.limited != 0};
  hand_.sound = !lost && !at_fault;
}

bool PresentationMeter::goes_forward(const HalfStroke& half) const noexcept {
  return (half.to_x_m - half.from_x_m) * parameters_.forward[0] +
             (half.to_y_m - half.from_y_m) * parameters_.forward[1] >
         0.0;
}

void PresentationMeter::take_half(const HalfStroke& half) {
  if (!half.whole) return;
  if (there_ && is_closed(open_m(*there_, half), std::max(there_->width_m, half.width_m))) {
    if (there_->sound && half.sound) {
      result_.sums.strokes.add(*there_, half, parameters_.strokes.period_s);
    }
    there_.reset();
  } else {
    there_ = half;
  }
  if (!half.sound || half.pause_s > 0.0) {
    before_ = {};
    return;
  }
  lay_over(half);
  before_ = {before_[1], half};
}

void PresentationMeter::lay_over(const HalfStroke& half) {
  const auto& [second_last, last] = before_;
  if (!last || goes_forward(*last) == goes_forward(half)) return;
  if (second_last && !goes_forward(*second_last) && !goes_forward(half)) {
    has_continuous_ |= result_.sums.curves.add_continuous(buffer_, *second_last, *last, half);
  }
  const double open_ratio = open_m(*last, half) / std::max(last->width_m, half.width_m);
  if (open_ratio < std::min(kMostOpenRatio, alone_ ? alone_->open_ratio : 1.0)) {
    alone_ = {*last, half, open_ratio};
  }
}

void PresentationMeter::end_stretch() {
  if (alone_ && !has_continuous_) {
    result_.sums.curves.add_joined(buffer_, alone_->first, alone_->second,
                                   !goes_forward(alone_->first));
  }
  finder_.restart();
  buffer_.restart();
  before_ = {};
  there_.reset();
  alone_.reset();
  has_continuous_ = false;
}

PresentationMeter::Result PresentationMeter::finish() {
  PresentationMovement& movement = result_.movement;
  movement.marks.missing_ticks += std::max<std::int64_t>(0, movement.last_tick - last_tick_);
  end_stretch();
  movement.strokes = result_.sums.strokes.means();
  movement.mean_height_m = result_.sums.mean_height_m();
  movement.force = result_.sums.force.delivered();
  return std::exchange(result_, {});
}

}  // namespace jnd::analysis
