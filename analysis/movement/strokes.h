#pragma once

#include <Eigen/Core>
#include <optional>

namespace jnd::analysis {

/// How a hand moved back and forth in a presentation. A stroke is a full cycle, from a turning
/// point to the other side and back (thesis, D.4).
struct StrokeSummary {
  int num_strokes = 0;
  /// The mean distance between successive turning points of whole strokes in the horizontal
  /// plane.
  std::optional<double> stroke_width_m;
  /// The mean over the strokes of the highest speed in each: "maximum velocity" in the thesis.
  std::optional<double> max_speed_m_per_s;
  /// The mean over all time that was fed, with or without strokes.
  std::optional<double> mean_height_m;
  double duration_s = 0.0;  ///< The time that was fed.
};

/// Whether a way there and a way back form a stroke: the end is near the beginning, within this
/// share of the stroke's width (an assumption). If a presentation starts during a motion and
/// the hand turns before its usual end, it makes a turning point there, but no half stroke.
[[nodiscard]] constexpr bool is_closed(double open_m, double wider_half_m) noexcept {
  constexpr double kMostOpenRatio = 0.4;
  return open_m <= kMostOpenRatio * wider_half_m;
}

/// Finds the strokes of one presentation while it happens. It needs no axis: a half stroke
/// points from the last turning point to the farthest point since then, whatever the
/// orientation of the hand in the frame. The farthest point becomes a turning point once the
/// hand has come back from it by the hysteresis, so trembling and pauses make none. The way to
/// the first turning point counts for no stroke, because the hand may start anywhere. A way
/// there that the way back does not close counts for none either; the way back then becomes the
/// way there of the next stroke.
///
/// Peak speeds are taken from the velocities as fed, so noisy ones should be filtered first.
/// Real time except the constructor: no heap, about 10 ns per tick.
class StrokeMeter {
 public:
  struct Parameters {
    double hysteresis_m = 0.03;  ///< > 0, and less than half of any stroke that should count.
  };

  /// Throws `core::Error` that names the offending field.
  explicit StrokeMeter(const Parameters& parameters);

  /// Takes one tick: the position and velocity of the hand in a frame with z up. `duration_s`
  /// >= 0 is the time that the tick represents. A tick that is not finite is left out.
  /// Real time.
  void feed(const Eigen::Vector3d& position_m, const Eigen::Vector3d& velocity_m_per_s,
            double duration_s) noexcept;

  /// The number of whole strokes so far, as `finish` would count them. Real time.
  [[nodiscard]] int num_strokes() const noexcept { return progress_.num_strokes; }

  /// The summary of what was fed since the construction or the last call. Starts anew.
  /// Real time.
  StrokeSummary finish() noexcept;

 private:
  /// The motion from one turning point to the next.
  struct Half {
    double from_x_m = 0.0, from_y_m = 0.0, width_m = 0.0;
    double peak = 0.0;  ///< The largest squared speed.
  };
  struct Progress {
    bool started = false, turned = false, is_back = false;
    int num_strokes = 0;
    Half there;                                     ///< The half before, if `is_back` is true.
    double from_x_m = 0.0, from_y_m = 0.0;          ///< The last turning point, or the start.
    double farthest_x_m = 0.0, farthest_y_m = 0.0;  ///< The farthest point from it since then.
    double width_squared_m2 = 0.0;                  ///< The squared distance between the two.
    double peak_to_farthest = 0.0, peak_since_farthest = 0.0;  ///< Largest squared speeds.
    double sum_width_m = 0.0, sum_peak_m_per_s = 0.0;          ///< Sums over whole strokes.
    double sum_height_m_s = 0.0, duration_s = 0.0;
  };

  void turn() noexcept;

  double hysteresis_squared_m2_;
  Progress progress_;
};

}  // namespace jnd::analysis
