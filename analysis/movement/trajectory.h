#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "analysis/movement/presentation_movement.h"
#include "core/sample.h"

namespace jnd::analysis {

/// A path without a gap, workspace frame; about 50 points a second.
struct Path {
  std::vector<double> x_m, y_m, z_m;
};

/// Where the hand went in one repetition of a block (thesis, fig. D.16, D.24): its first
/// minute.
struct Trajectory {
  std::string block;
  std::int64_t repetition = 0;
  std::vector<Path> hand;          ///< Mean of the device's points; one a stretch without gaps.
  std::vector<Path> end_effector;  ///< The end effector; one path a stretch without gaps.
};

/// Takes the paths of a participant's presentations. Not real time.
class TrajectoryTaker {
 public:
  explicit TrajectoryTaker(double rate_hz);

  /// Samples that come now belong to this presentation.
  void begin(const PresentationMovement& presentation);
  void feed(const HandTick& hand, const core::Sample& sample);
  /// By block and repetition.
  [[nodiscard]] std::vector<Trajectory> finish();

 private:
  std::int64_t stride_;  ///< Of so many ticks one is taken.
  std::map<std::pair<std::string, std::int64_t>, Trajectory> all_;
  std::map<std::pair<std::string, std::int64_t>, std::int64_t> num_points_;
  Trajectory* current_ = nullptr;
  std::int64_t* current_points_ = nullptr;
  std::int64_t first_tick_ = 0, last_tick_ = 0;
  bool path_is_open_ = false;
};

}  // namespace jnd::analysis
