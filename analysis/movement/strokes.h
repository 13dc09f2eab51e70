#pragma once

#include <Eigen/Core>
#include <optional>

namespace jnd::analysis {

/// How a hand moved back and forth over a presentation. A stroke is a full cycle, from a
/// turning point to the other side and back (thesis, D.4).
struct StrokeSummary {
  int num_strokes = 0;
  /// Mean distance between successive turning points of whole strokes, in the horizontal plane.
  std::optional<double> stroke_width_m;
  /// Mean over the strokes of the highest speed in each: "maximum velocity" of the thesis.
  std::optional<double> max_speed_m_per_s;
  std::optional<double> mean_height_m;  ///< Over all time that was fed, strokes or not.
  double duration_s = 0.0;              ///< That was fed.
};

/// Whether a way there and a way back are a stroke: it ends near where it began, within this
/// part of its width (an assumption). A hand that a presentation found on its way, and that
/// turned before it came to its usual end, has made a turning point there, but no half of a
/// stroke.
[[nodiscard]] constexpr bool is_closed(double open_m, double wider_half_m) noexcept {
  constexpr double kMostOpenRatio = 0.4;
  return open_m <= kMostOpenRatio * wider_half_m;
}

/// Finds the strokes of one presentation while it happens. It needs no axis: the direction of a
/// half stroke is that from the last turning point to the farthest point since, so it follows
/// the hand however it stands to the frame. That farthest point becomes a turning point once
/// the hand has come back from it by the hysteresis; trembling and pauses therefore make none.
/// The way to the first turning point counts for no stroke, for the hand may start anywhere,
/// nor does a way there that the way back does not close: then that one is the way there of the
/// next.
///
/// Peak speeds are of the velocities as fed: filter noisy ones before. Real time except the
/// constructor: no heap, about 10 ns a tick.
class StrokeMeter {
 public:
  struct Parameters {
    double hysteresis_m = 0.03;  ///< > 0; less than half of any stroke that shall count.
  };

  /// Throws `core::Error` naming the offending field.
  explicit StrokeMeter(const Parameters& parameters);

  /// One tick: where the hand is and how fast, frame with z up; `duration_s` >= 0 is the time
  /// the tick stands for. A tick that is not finite is left out. Real time.
  void feed(const Eigen::Vector3d& position_m, const Eigen::Vector3d& velocity_m_per_s,
            double duration_s) noexcept;

  /// Whole strokes so far, as `finish` would count them. Real time.
  [[nodiscard]] int num_strokes() const noexcept { return progress_.num_strokes; }

  /// What was fed since the construction or the last call. Starts anew. Real time.
  StrokeSummary finish() noexcept;

 private:
  /// From one turning point to the next.
  struct Half {
    double from_x_m = 0.0, from_y_m = 0.0, width_m = 0.0;
    double peak = 0.0;  ///< Squared speed.
  };
  struct Progress {
    bool started = false, turned = false, is_back = false;
    int num_strokes = 0;
    Half there;                                     ///< The half before, where `is_back`.
    double from_x_m = 0.0, from_y_m = 0.0;          ///< Last turning point, or the start.
    double farthest_x_m = 0.0, farthest_y_m = 0.0;  ///< Farthest from it since.
    double width_squared_m2 = 0.0;                  ///< Squared distance between the two.
    double peak_to_farthest = 0.0, peak_since_farthest = 0.0;  ///< Squared speeds.
    double sum_width_m = 0.0, sum_peak_m_per_s = 0.0;          ///< Over whole strokes.
    double sum_height_m_s = 0.0, duration_s = 0.0;
  };

  void turn() noexcept;

  double hysteresis_squared_m2_;
  Progress progress_;
};

}  // namespace jnd::analysis
