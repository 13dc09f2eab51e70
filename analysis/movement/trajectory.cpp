#include "analysis/movement/trajectory.h"

#include <algorithm>
#include <cmath>

namespace jnd::analysis {
namespace {

constexpr double kPointsHz = 50.0;
constexpr std::int64_t kMostPoints = 3000;

void append(Path& path, double x_m, double y_m, double z_m) {
  path.x_m.push_back(x_m);
  path.y_m.push_back(y_m);
  path.z_m.push_back(z_m);
}

}  // namespace

TrajectoryTaker::TrajectoryTaker(double rate_hz)
    : stride_(std::max<std::int64_t>(1, std::llround(rate_hz / kPointsHz))) {}

void TrajectoryTaker::begin(const PresentationMovement& presentation) {
  const std::pair key(presentation.block, presentation.repetition);
  current_ = &all_[key];
  current_->block = presentation.block;
  current_->repetition = presentation.repetition;
  current_points_ = &num_points_[key];
  first_tick_ = presentation.first_tick;
  path_is_open_ = false;
}

void TrajectoryTaker::feed(const HandTick& hand, const core::Sample& sample) {
  if (path_is_open_ && hand.tick != last_tick_ + 1) path_is_open_ = false;
  last_tick_ = hand.tick;
  if ((hand.tick - first_tick_) % stride_ != 0 || *current_points_ >= kMostPoints) return;
  if (!path_is_open_) {
    current_->hand.emplace_back();
    current_->end_effector.emplace_back();
    path_is_open_ = true;
  }
  ++*current_points_;
  append(current_->hand.back(), hand.x_m, hand.y_m, hand.z_m);
  const core::PlainVector& end = sample.end_effector_position_m;
  append(current_->end_effector.back(), end[0], end[1], end[2]);
}

std::vector<Trajectory> TrajectoryTaker::finish() {
  std::vector<Trajectory> trajectories;
  for (auto& [key, trajectory] : all_) trajectories.push_back(std::move(trajectory));
  all_.clear();
  num_points_.clear();
  current_ = nullptr;
  return trajectories;
}

}  // namespace jnd::analysis
