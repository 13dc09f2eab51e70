#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis/movement/presentation_movement.h"
#include "core/sample.h"

namespace jnd::analysis {

/// A path without a gap in the workspace frame, with about 50 points per second.
struct Path {
  std::vector<double> x_m, y_m, z_m;
};

/// The path of the hand in the first minute of one repetition of a block (thesis, fig. D.16,
/// D.24).
struct Trajectory {
  std::string block;
  std::int64_t repetition = 0;
  /// The mean of the device's points, with one path for each stretch without gaps.
  std::vector<Path> hand;
  /// The end effector, with one path for each stretch without gaps.
  std::vector<Path> end_effector;
};

/// Collects the paths of a participant's presentations. Not real time.
class TrajectoryTaker {
 public:
  explicit TrajectoryTaker(double rate_hz);

  /// The samples that follow belong to this presentation.
  void begin(const PresentationMovement& presentation);
  void feed(const HandTick& hand, const core::Sample& sample);
  /// The trajectories by block and repetition.
  [[nodiscard]] std::vector<Trajectory> finish();

 private:
  std::int64_t stride_;  ///< One of this many ticks is used.
  std::map<std::pair<std::string, std::int64_t>, Trajectory> all_;
  std::map<std::pair<std::string, std::int64_t>, std::int64_t> num_points_;
  Trajectory* current_ = nullptr;
  std::int64_t* current_points_ = nullptr;
  std::int64_t first_tick_ = 0, last_tick_ = 0;
  bool path_is_open_ = false;
};

}  // namespace jnd::analysis
