#pragma once

#include <array>
#include <cstdint>

#include "core/hand.h"

namespace jnd::core {

/// Finds a position sensor that died while the hand rested. A solid or a float pushes a hand
/// that stands still, so a position that no longer changes would hold that force for ever.
///
/// A point under force whose position repeats to the last digit for `max_still_s` loses its
/// force over `fade_s`: a hand that is free of it moves, and any change of position brings the
/// force back over `return_s`. Friction and coarse sensors make true stillness common, so a
/// point is called frozen only after `confirm_s` without any force and without any change. A
/// point whose position stands still while its own velocity carried it `max_way_m` away is
/// frozen at once; that way is forgotten with a time constant of `memory_s`, so that noise and
/// bias below their ratio, 1 cm/s, never add up. Real time except the constructor.
class StillnessWatch {
 public:
  struct Parameters {
    double max_still_s = 2.0;  ///< > 0, finite; as `DeviceCapabilities` have it.
    double fade_s = 2.0;       ///< > 0, finite.
    double confirm_s = 1.0;    ///< > 0, finite.
    double return_s = 0.5;     ///< > 0, finite.
    double max_way_m = 0.01;   ///< > 0, finite.
    double memory_s = 1.0;     ///< > 0, finite; of that way.
  };

  /// Throws `Error` naming the field; a tick lasts `period_s`. Not real time.
  StillnessWatch(const Parameters& parameters, double period_s);

  /// One measurement, `elapsed_s` > 0 after the one before by the loop's time, also where ticks
  /// or measurements were missed in between; workspace frame. `pushed_bits` tells, a bit a
  /// point, which would feel a force that does not depend on motion if this watch took none
  /// away.
  void observe(const PointVectors& tip_position_m, const PointVectors& tip_velocity_m_per_s,
               const std::array<bool, kNumContactPoints>& attached, std::uint8_t pushed_bits,
               double elapsed_s) noexcept;

  /// What the force of a point is multiplied by, 0 to 1.
  [[nodiscard]] double authority_ratio(int point) const noexcept {
    return points_[static_cast<std::size_t>(point)].authority_ratio;
  }
  /// A force is being taken away until the hand moves.
  [[nodiscard]] bool asks_to_move() const noexcept { return asks_to_move_; }
  [[nodiscard]] bool is_frozen() const noexcept { return is_frozen_; }

  /// Forgets all, as before the first tick.
  void reset() noexcept;

 private:
  struct Point {
    bool has_last = false;
    Eigen::Vector3d last_position_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d way_m = Eigen::Vector3d::Zero();  ///< By its velocity, standing still.
    double still_s = 0.0;                             ///< Under force.
    double without_force_s = 0.0;                     ///< After the force was taken away.
    double authority_ratio = 1.0;
  };

  void take_force_away(Point& point, double elapsed_s) noexcept;

  Parameters parameters_;
  double period_s_;
  bool asks_to_move_ = false;
  bool is_frozen_ = false;
  std::array<Point, kNumContactPoints> points_;
};

}  // namespace jnd::core
