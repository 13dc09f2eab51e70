#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "core/random_stream.h"

namespace jnd::device {

/// The movement in one presentation, as the person tends to make it.
struct StrokePlan {
  double amplitude_m = 0.28;  ///< Half the width of a stroke, [0.001, 2].
  /// Speed of the reference in the middle of a stroke, [0.001, 5].
  double max_speed_m_per_s = 0.45;
  double height_m = -0.15;  ///< Mean height in the workspace frame, [-5, 5].
  /// The hand is lower by this in the middle of a stroke forward, and higher on the way back;
  /// [-1, 1].
  double lift_m = 0.015;
  /// Standard deviations between strokes, relative for amplitude and speed.
  double amplitude_sd_ratio = 0.05;  ///< [0, 0.3]
  double speed_sd_ratio = 0.05;      ///< [0, 0.3]
  double height_sd_m = 0.005;        ///< [0, 0.5]
  double sideways_sd_m = 0.005;      ///< [0, 0.5], of the turning points along y.
  /// After these strokes the hand goes home, [0, 1'000'000]; 0 means that it strokes until the
  /// next order.
  std::int64_t num_strokes = 0;
};

/// Throws `Error` naming the field that is out of range. Not real time.
void require_valid(const StrokePlan& plan);

/// Whether every field is within its range, so that the arm's arithmetic cannot overflow. Real
/// time.
[[nodiscard]] bool is_valid(const StrokePlan& plan) noexcept;

/// A simulated person's arm. It pulls the hand with a finite impedance towards a point that
/// strokes back and forth along x,
///
///   force = stiffness (reference - position) + damping (reference velocity - velocity),
///
/// so a thicker medium slows the hand down. A stroke is a full cycle, from one turning point to
/// the other and back, half a cosine in each direction. Its width, speed and height are drawn
/// for every stroke. Neither the reference nor its velocity ever jumps. Single-threaded; real
/// time except the constructor.
class StrokingArm {
 public:
  struct Parameters {
    double stiffness_n_per_m = 300.0;                         ///< >= 0.
    double damping_n_s_per_m = 20.0;                          ///< >= 0.
    double home_x_m = 0.0, home_y_m = 0.0, home_z_m = -0.15;  ///< Where the arm rests.
    double home_s = 0.6;  ///< Time in which the reference goes home, > 0.
  };

  /// Throws `Error` naming the field; `period_s` > 0. Starts at home. Not real time.
  StrokingArm(const Parameters& parameters, double period_s);

  /// Strokes from the present place of the reference. `random` is this presentation's own
  /// stream. The plan must be within its ranges (`require_valid`).
  void begin_strokes(const StrokePlan& plan, const core::RandomStream& random) noexcept;
  /// Moves smoothly home from the present place of the reference.
  void go_home() noexcept;

  /// Moves the reference by one tick.
  void advance() noexcept;

  /// Returns the force on the hand, in the workspace frame.
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
  /// Returns the number of whole strokes since `begin_strokes`.
  [[nodiscard]] std::int64_t strokes_finished() const noexcept { return strokes_finished_; }
  /// Whether the reference has come to rest at home. The hand follows within its impedance.
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
  // Speed and turning points of the present stroke, as drawn.
  double speed_m_per_s_ = 0.0;
  Eigen::Vector3d near_end_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d far_end_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_start_m_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d half_end_m_ = Eigen::Vector3d::Zero();
  // A phasor that is turned by a constant angle in each tick, so that the tick computes no
  // sine.
  double cosine_ = 1.0, sine_ = 0.0;
  double step_cosine_ = 1.0, step_sine_ = 0.0;
  double angular_speed_rad_per_s_ = 0.0;
};

}  // namespace jnd::device
