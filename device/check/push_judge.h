#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>

#include "device/check/device_rule.h"

namespace jnd::device {

inline constexpr DeviceRule kActed = {
    "acted", "The force that it tells of is the one that was asked for, at the same point.",
    "Tell in acted_n the force on the hand in N, in the workspace frame, of each point in its "
    "place."};
inline constexpr DeviceRule kPoints = {
    "points", "A push at a point moves no other point further.",
    "Compare the order of the points of forces with that of positions: palm inner, palm outer, "
    "thumb, index finger, middle finger."};
inline constexpr DeviceRule kForceSize = {
    "force_size", "A push moves the device no further than its own mass allows.",
    "Look at the unit of the forces and at the gears between motor and point, then at the own "
    "mass that is told."};
inline constexpr DeviceRule kDelay = {
    "delay", "A force acts within the delay that the device tells, and moves the hand then.",
    "Give each force with the write that brings it, tell in acted_n what acted by now, and "
    "tell "
    "the delay."};

/// Judges what pushes show besides their direction: how large they are, at which point, what
/// the device tells of them, and how late they come.
class PushJudge {
 public:
  explicit PushJudge(const DeviceCapabilities& can) : can_(can) {}

  struct Push {
    int point = 0;
    Eigen::Vector3d force_n = Eigen::Vector3d::Zero();  ///< Along one axis; it stays the same.
    std::span<const core::HapticState> before;          ///< Without any force.
    std::span<const core::HapticState> during;          ///< From the first tick with the push.
  };
  void observe(const Push& push);

  /// Judges `acted`, `points` and `force_size`.
  void judge(RuleJudge& judge) const;
  /// Judges `delay`, of a driver.
  void judge_delay(RuleJudge& judge) const;

 private:
  void observe_acted(const Push& push);
  void observe_motion(const Push& push, int axis);

  DeviceCapabilities can_;
  int num_told_ = 0, num_moved_ = 0;
  std::string untold_, elsewhere_, too_far_;
  /// Shortest times from a push to what is told of it, and from there to a motion.
  double told_after_s_ = std::numeric_limits<double>::infinity();
  double moved_after_s_ = std::numeric_limits<double>::infinity();
};

}  // namespace jnd::device
