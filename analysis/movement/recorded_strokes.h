#pragma once

#include <cstdint>
#include <optional>

namespace jnd::analysis {

/// Means over whole strokes. A stroke is a full cycle, from a turning point to the other side
/// and back (thesis, D.4). All are empty without a stroke.
struct StrokeMeans {
  int num_strokes = 0;
  /// The distance between turning points in the horizontal plane.
  std::optional<double> stroke_width_m;
  /// The mean over strokes of the highest speed in each.
  std::optional<double> max_speed_m_per_s;
  std::optional<double> mean_speed_m_per_s;  ///< The mean over the time of the strokes.
  std::optional<double> stroke_duration_s;   ///< The duration including pauses.
  std::optional<double> pause_s;             ///< The time at rest in each stroke.
  /// The energy that the rendered force takes from the hand.
  std::optional<double> stroke_energy_j;
};

/// The part of a sample that strokes need, in the workspace frame.
struct HandTick {
  std::int64_t tick = 0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  ///< The mean of the points.
  double forward_velocity_m_per_s = 0.0;
  double speed_m_per_s = 0.0;
  double opposing_force_n =
      /// The delivered force (`core::delivered_force_n`) against the motion.
      0.0;
  double dissipated_w = 0.0;  ///< The power that this force takes from the hand.
  bool sound = true;          ///< Whether no contact was lost and there was no fault.
};

/// The motion from one turning point to the next.
struct HalfStroke {
  std::int64_t first_tick = 0, last_tick = 0;  ///< The ticks of the two turning points.
  double from_x_m = 0.0, from_y_m = 0.0, to_x_m = 0.0, to_y_m = 0.0;
  double width_m = 0.0;
  double max_speed_m_per_s = 0.0;
  double path_m = 0.0;
  double pause_s = 0.0;
  double energy_j = 0.0;
  bool sound = true;  ///< Whether every tick of it was sound.
  /// Whether it began at a turning point, and not where the recording began.
  bool whole = false;

  [[nodiscard]] std::int64_t num_ticks() const noexcept { return last_tick - first_tick; }
};

/// Finds half strokes in a recording by the rule of `StrokeMeter`, with the ticks of their
/// turning points. A turning point is known only after the hand has come back by the
/// hysteresis. Rest in between makes no turning point and counts as pause. Not real time.
class HalfStrokeFinder {
 public:
  struct Parameters {
    double period_s = 0.001;  ///< > 0.
    /// > 0, and less than half of any stroke that should count.
    double hysteresis_m = 0.03;
    double rest_speed_m_per_s = 0.02;  ///< Below this speed the hand rests. >= 0.
    double shortest_pause_s = 0.15;    ///< A shorter rest belongs to a turning point. >= 0.
  };

  /// Throws `core::Error` that names the field.
  explicit HalfStrokeFinder(const Parameters& parameters);

  /// Takes ticks in their order without a gap. Returns the half stroke that this tick
  /// completes, if any.
  std::optional<HalfStroke> feed(const HandTick& hand) noexcept;

  /// Forgets everything, for a gap or another presentation.
  void restart() noexcept { progress_ = {}; }

 private:
  /// Sums over a half stroke.
  struct Sums {
    double max_speed_m_per_s = 0.0, path_m = 0.0, pause_s = 0.0, energy_j = 0.0;
    bool sound = true;
    void add(const Sums& other) noexcept;
  };
  struct Progress {
    bool started = false, turned = false;
    std::int64_t from_tick = 0, farthest_tick = 0;
    double from_x_m = 0.0, from_y_m = 0.0, farthest_x_m = 0.0, farthest_y_m = 0.0;
    double width_squared_m2 = 0.0;
    std::int64_t rest_ticks = 0;  ///< The number of ticks at rest without a break until now.
    Sums to_farthest, since_farthest;
  };

  void count_rest(const HandTick& hand) noexcept;
  HalfStroke turn(const HandTick& hand) noexcept;

  Parameters parameters_;
  std::int64_t shortest_pause_ticks_;
  Progress progress_;
};

/// Adds up whole strokes.
class StrokeSums {
 public:
  void add(const HalfStroke& there, const HalfStroke& back, double period_s) noexcept;
  void add(const StrokeSums& other) noexcept;
  [[nodiscard]] StrokeMeans means() const noexcept;

 private:
  int num_strokes_ = 0;
  double width_m_ = 0.0, max_speed_m_per_s_ = 0.0, path_m_ = 0.0, duration_s_ = 0.0;
  double pause_s_ = 0.0, energy_j_ = 0.0;
};

}  // namespace jnd::analysis
