#include "analysis/movement/normalised_stroke.h"

#include <algorithm>
#include <cmath>

namespace jnd::analysis {
namespace {

constexpr std::size_t kNumPoints = 101;

}  // namespace

StrokeBuffer::StrokeBuffer(std::size_t capacity, bool has_joints)
    : capacity_(std::max<std::size_t>(2, capacity)),
      has_joints_(has_joints),
      places_(capacity_),
      hand_(capacity_),
      joints_(has_joints ? capacity_ : 0) {}

void StrokeBuffer::push(const HandTick& hand, const core::Sample& sample) {
  if (hand.tick != last_tick_ + 1) size_ = 0;
  last_tick_ = hand.tick;
  size_ = std::min(size_ + 1, static_cast<std::int64_t>(capacity_));
  const std::size_t at = slot(hand.tick);
  places_[at] = {hand.x_m, hand.y_m};
  double* channel = hand_[at].data();
  *channel++ = hand.forward_velocity_m_per_s;
  *channel++ = hand.z_m;
  *channel++ = hand.opposing_force_n;
  const core::PlainVector& end = sample.end_effector_position_m;
  for (const core::PlainVector& tip : sample.tip_position_m) {
    const double x = tip[0] - end[0], y = tip[1] - end[1], z = tip[2] - end[2];
    *channel++ = std::sqrt(x * x + y * y + z * z);
  }
  if (!has_joints_) return;
  std::ranges::copy(sample.joint_position_rad, joints_[at].begin());
  std::ranges::copy(sample.joint_torque_n_m, joints_[at].begin() + core::kNumJoints);
}

std::optional<double> StrokeBuffer::passes_middle(const HalfStroke& half,
                                                  std::int64_t first_tick,
                                                  std::int64_t last_tick) const {
  if (!holds(first_tick) || !holds(last_tick)) return std::nullopt;
  const double x = half.to_x_m - half.from_x_m, y = half.to_y_m - half.from_y_m;
  const double middle_x_m = 0.5 * (half.to_x_m + half.from_x_m);
  const double middle_y_m = 0.5 * (half.to_y_m + half.from_y_m);
  const auto off_middle = [&](std::int64_t tick) {
    const Place& place = places_[slot(tick)];
    return (place.x_m - middle_x_m) * x + (place.y_m - middle_y_m) * y;
  };
  const std::int64_t step = last_tick > first_tick ? 1 : -1;
  double before = off_middle(first_tick);
  for (std::int64_t tick = first_tick; tick != last_tick; tick += step) {
    const double after = off_middle(tick + step);
    if ((before < 0.0) != (after < 0.0)) {
      return static_cast<double>(tick) + static_cast<double>(step) * before / (before - after);
    }
    before = after;
  }
  return std::nullopt;
}

void StrokeBuffer::values_at(double tick, std::array<double, kNumChannels>& values) const {
  const double whole = std::floor(tick);
  const auto first = static_cast<std::int64_t>(whole);
  const double ratio = tick - whole;
  const std::size_t from = slot(first);
  // A time that equals a tick needs no neighbour, which may be missing.
  const std::size_t to = ratio > 0.0 ? slot(first + 1) : from;
  const auto between = [ratio](double low, double high) { return low + ratio * (high - low); };
  for (std::size_t i = 0; i < kNumHandChannels; ++i) {
    values[i] = between(hand_[from][i], hand_[to][i]);
  }
  for (std::size_t i = 0; has_joints_ && i < kNumJointChannels; ++i) {
    values[kNumHandChannels + i] = between(joints_[from][i], joints_[to][i]);
  }
}

void BandSums::add(const std::vector<double>& values) {
  mean_.resize(values.size());
  squares_.resize(values.size());
  ++num_strokes_;
  // The update of Welford (1962).
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double off = values[i] - mean_[i];
    mean_[i] += off / num_strokes_;
    squares_[i] += off * (values[i] - mean_[i]);
  }
}

void BandSums::add(const BandSums& other) {
  if (other.num_strokes_ == 0) return;
  if (num_strokes_ == 0) {
    *this = other;
    return;
  }
  const double n = num_strokes_, m = other.num_strokes_;
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    const double off = other.mean_[i] - mean_[i];
    mean_[i] += off * m / (n + m);
    squares_[i] += other.squares_[i] + off * off * n * m / (n + m);
  }
  num_strokes_ += other.num_strokes_;
}

CurveBand BandSums::band(std::size_t first, std::size_t num_points) const {
  CurveBand band;
  if (num_strokes_ == 0) return band;
  const auto begin = static_cast<std::ptrdiff_t>(first);
  const auto end = static_cast<std::ptrdiff_t>(first + num_points);
  band.mean.assign(mean_.begin() + begin, mean_.begin() + end);
  if (num_strokes_ == 1) return band;
  for (std::size_t i = first; i < first + num_points; ++i) {
    band.standard_deviation.push_back(std::sqrt(squares_[i] / (num_strokes_ - 1)));
  }
  return band;
}

bool StrokeCurveSums::add_continuous(const StrokeBuffer& buffer, const HalfStroke& back_before,
                                     const HalfStroke& forward, const HalfStroke& back) {
  const auto first = buffer.passes_middle(forward, forward.first_tick, back_before.first_tick);
  const auto last = buffer.passes_middle(forward, forward.last_tick, back.last_tick);
  if (!first || !last) return false;
  if (!add(buffer, *first, *last, std::nullopt, 0)) return false;
  const double duration = *last - *first;
  turns_.add({100.0 * (static_cast<double>(forward.first_tick) - *first) / duration,
              100.0 * (static_cast<double>(forward.last_tick) - *first) / duration});
  return true;
}

void StrokeCurveSums::add_joined(const StrokeBuffer& buffer, const HalfStroke& first,
                                 const HalfStroke& second, bool first_is_back) {
  const HalfStroke& back = first_is_back ? first : second;
  const auto middle = buffer.passes_middle(back, back.first_tick, back.last_tick);
  if (!middle || !buffer.holds(first.first_tick) || !buffer.holds(second.last_tick)) return;
  const auto begin = static_cast<double>(first.first_tick);
  const auto turn = static_cast<double>(first.last_tick);
  const auto end = static_cast<double>(second.last_tick);
  const double duration = end - begin;
  if (!add(buffer, *middle, *middle + duration, second.last_tick, first.first_tick)) return;
  const double to_end = 100.0 * (end - *middle) / duration;
  const double to_turn = 100.0 * (turn - *middle) / duration;
  if (first_is_back) {
    turns_.add({to_turn, to_end});
  } else {
    turns_.add({to_end, to_turn + 100.0});
  }
  ++num_joined_;
}

/// With a seam, time continues at `joined_tick` once it has reached `seam_tick`.
bool StrokeCurveSums::add(const StrokeBuffer& buffer, double first_tick, double last_tick,
                          std::optional<std::int64_t> seam_tick, std::int64_t joined_tick) {
  constexpr std::size_t kHand = StrokeBuffer::kNumHandChannels;
  std::vector<double> hand(kHand * kNumPoints);
  std::vector<double> joints(buffer.has_joints() ? StrokeBuffer::kNumJointChannels * kNumPoints
                                                 : 0);
  std::array<double, StrokeBuffer::kNumChannels> values{};
  for (std::size_t point = 0; point < kNumPoints; ++point) {
    const double ratio = static_cast<double>(point) / (kNumPoints - 1);
    double tick = (1.0 - ratio) * first_tick + ratio * last_tick;
    if (seam_tick && tick > static_cast<double>(*seam_tick)) {
      tick += static_cast<double>(joined_tick) - static_cast<double>(*seam_tick);
    }
    buffer.values_at(tick, values);
    for (std::size_t i = 0; i < kHand; ++i) hand[i * kNumPoints + point] = values[i];
    for (std::size_t i = 0; i * kNumPoints < joints.size(); ++i) {
      joints[i * kNumPoints + point] = values[kHand + i];
    }
  }
  // A tick is left out earlier if a tip is not finite, but end effector and joints have not
  // been checked.
  const auto is_finite = [](double value) { return std::isfinite(value); };
  if (!std::ranges::all_of(hand, is_finite) || !std::ranges::all_of(joints, is_finite)) {
    return false;
  }
  hand_.add(hand);
  if (!joints.empty()) joints_.add(joints);
  return true;
}

void StrokeCurveSums::add(const StrokeCurveSums& other) {
  hand_.add(other.hand_);
  joints_.add(other.joints_);
  turns_.add(other.turns_);
  num_joined_ += other.num_joined_;
}

StrokeCurves StrokeCurveSums::curves() const {
  StrokeCurves curves{.num_strokes = hand_.num_strokes(), .num_joined = num_joined_};
  if (curves.num_strokes == 0) return curves;
  for (std::size_t point = 0; point < kNumPoints; ++point) {
    curves.stroke_percent.push_back(static_cast<double>(point));
  }
  curves.turn_forward_percent = turns_.band(0, 1).mean[0];
  curves.turn_back_percent = turns_.band(1, 1).mean[0];
  std::size_t channel = 0;
  const auto next = [&channel](const BandSums& sums) {
    return sums.band(kNumPoints * channel++, kNumPoints);
  };
  curves.forward_velocity_m_per_s = next(hand_);
  curves.height_m = next(hand_);
  curves.opposing_force_n = next(hand_);
  for (CurveBand& distance : curves.tip_distance_m) distance = next(hand_);
  curves.has_joints = joints_.num_strokes() > 0;
  if (!curves.has_joints) return curves;
  channel = 0;
  for (CurveBand& position : curves.joint_position_rad) position = next(joints_);
  for (CurveBand& torque : curves.joint_torque_n_m) torque = next(joints_);
  return curves;
}

}  // namespace jnd::analysis
