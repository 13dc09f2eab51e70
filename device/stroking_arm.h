#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/random_stream.h"

namespace jnd::device {

/// One presentation's movement, as its person tends to make it.
struct StrokePlan {
  double amplitude_m = 0.28;        ///< Half the width of a stroke, [0.001, 2].
  double max_speed_m_per_s = 0.45;  ///< Of the reference, in mid-stroke, [0.001, 5].
  double height_m = -0.15;          ///< Mean height in the workspace frame, [-5, 5].
  /// Lower by this in mid-stroke forward, higher on the way back; [-1, 1].
  double lift_m = 0.015;
  /// Spread between strokes (sd): relative for amplitude and speed.
  double amplitude_sd_ratio = 0.05;  ///< [0, 0.3]
  double speed_sd_ratio = 0.05;      ///< [0, 0.3]
  double height_sd_m = 0.005;        ///< [0, 0.5]
  double sideways_sd_m = 0.005;      ///< [0, 0.5] Of the turning points, along y.
  /// Then home, [0, 1'000'000]; 0 is to go on until told otherwise.
  std::int64_t num_strokes = 0;
};

/// Throws `Error` naming the field that is out of range. Not real time.
void require_valid(const StrokePlan& plan);

/// Whether every field is within its range, which no arm's arithmetic overflows in. Real time.
[[nodiscard]] bool is_valid(const StrokePlan& plan) noexcept;

/// A simulated person's arm: it pulls the hand with a finite impedance towards a point that
/// strokes back and forth along x,
///
///     force = stiffness (reference - position) + damping (reference velocity - velocity),
///
/// so that a thicker medium slows the hand down. A stroke is a full cycle, from one turning
/// point to the other and back, half a cosine each way; its width, speed and height are drawn
/// anew for every stroke. Neither the reference nor its velocity ever jumps. Single-threaded;
/// real time except the constructor.
class StrokingArm {
 public:
  struct Parameters {
    double stiffness_n_per_m = 300.0;                         ///< >= 0.
    double damping_n_s_per_m = 20.0;                          ///< >= 0.
    double home_x_m = 0.0, home_y_m = 0.0, home_z_m = -0.15;  ///< Where the arm rests.
    double home_s = 0.6;  ///< Time the reference takes to get home, > 0.
  };

  /// Throws `Error` naming the field; `period_s` > 0. Starts at home. Not real time.
  StrokingArm(const Parameters& parameters, double period_s);

  /// Strokes from wherever the reference is; `random` is this presentation's own stream. The
  /// plan must be within its ranges (`require_valid`).
  void begin_strokes(const StrokePlan& plan, const core::RandomStream& random) noexcept;
  /// Eases home from wherever the reference is.
  void go_home() noexcept;

  /// Moves the reference on by one tick.
  void advance() noexcept;

  /// On the hand, workspace frame.
  [[nodiscard]] Eigen::Vector3d force_n(
      const Eigen::Vector3d& position_m,
      const Eigen::Vector3d& velocity_m_per_s) const noexcept {
    return parameters_.stiffness_n_per_m * (reference_m_ - position_m) +
           parameters_.damping_n_s_per_m * (reference_velocity_m_per_s_ - velocity_m_per_s);
  }

  [[nodiscard]] const Eigen::Vector3d& reference_m() const noexcept { return reference_m_; }
  [[nodiscard]] const Eigen::Vector3d& reference_velocity_m_per_s() const noexcept {
    return reference_velocity_m_per_s_;
  }
  /// Whole strokes since `begin_strokes`.
  [[nodiscard]] std::int64_t strokes_finished() const noexcept { return strokes_finished_; }
  /// The reference has come to rest at home; the hand follows within its impedance.
  [[nodiscard]] bool is_home() const noexcept { return phase_ == Phase::kHome; }

 private:
  enum class Phase { kHome, kGoingHome, kApproaching, kForward, kBack };

  void start_curve(Phase phase, const Eigen::Vector3d& to_m, double duration_s) noexcept;
  void advance_curve() noexcept;
  void draw_stroke() noexcept;
  void start_half_stroke(Phase phase, const Eigen::Vector3d& to_m) noexcept;
  void advance_half_stroke() noexcept;
  void turn() noexcept;

  Parameters parameters_;
  double period_s_;
  Phase phase_ = Phase::kHome;
  Eigen::Vector3d reference_m_;
  Eigen::Vector3d reference_velocity_m_per_s_ = Eigen::Vector3d::Zero();
  std::int64_t ticks_left_ = 0;

  // A cubic from the reference's position and velocity to rest, over the unit interval.
  double curve_ratio_ = 0.0, curve_step_ratio_ = 0.0;
  std::array<Eigen::Vector3d, 4> curve_;

  StrokePlan plan_;
  core::RandomStream random_{0, "stroke"};
  std::int64_t strokes_finished_ = 0;
  // The stroke being made: its speed and turning points, as drawn.
  double speed_m_per_s_ = 0.0;
  Eigen::Vector3d near_end_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d far_end_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_start_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_end_m_ = Eigen::Vector3d::Zero();
  // A phasor turned by a constant angle each tick: no sine in the tick.
  double cosine_ = 1.0, sine_ = 0.0;
  double step_cosine_ = 1.0, step_sine_ = 0.0;
  double angular_speed_rad_per_s_ = 0.0;
};

}  // namespace jnd::device
