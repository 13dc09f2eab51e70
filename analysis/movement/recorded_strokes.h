#pragma once

#include <cstdint>
#include <optional>

namespace jnd::analysis {

/// Means over whole strokes. A stroke is a full cycle, from a turning point to the other side
/// and back (thesis, D.4); all empty without one.
struct StrokeMeans {
  int num_strokes = 0;
  std::optional<double> stroke_width_m;      ///< Between turning points, horizontal plane.
  std::optional<double> max_speed_m_per_s;   ///< Mean of the highest speed in each stroke.
  std::optional<double> mean_speed_m_per_s;  ///< Over the time of the strokes.
  std::optional<double> stroke_duration_s;   ///< With pauses.
  std::optional<double> pause_s;             ///< At rest, a stroke.
  std::optional<double> stroke_energy_j;     ///< That the rendered force took from the hand.
};

/// What of a sample the strokes need, workspace frame.
struct HandTick {
  std::int64_t tick = 0;
  double x_m = 0.0, y_m = 0.0, z_m = 0.0;  ///< Mean of the points.
  double forward_velocity_m_per_s = 0.0;
  double speed_m_per_s = 0.0;
  double opposing_force_n =
      0.0;                    ///< Delivered (`core::delivered_force_n`), against the motion.
  double dissipated_w = 0.0;  ///< Power that this force takes from the hand.
  bool sound = true;          ///< No contact lost, no fault.
};

/// From one turning point to the next.
struct HalfStroke {
  std::int64_t first_tick = 0, last_tick = 0;  ///< The two turning points.
  double from_x_m = 0.0, from_y_m = 0.0, to_x_m = 0.0, to_y_m = 0.0;
  double width_m = 0.0;
  double max_speed_m_per_s = 0.0;
  double path_m = 0.0;
  double pause_s = 0.0;
  double energy_j = 0.0;
  bool sound = true;   ///< Every tick of it was.
  bool whole = false;  ///< It began at a turning point, not where the recording did.

  [[nodiscard]] std::int64_t num_ticks() const noexcept { return last_tick - first_tick; }
};

/// Finds half strokes in a recording, by the rule of `StrokeMeter`, with the ticks of their
/// turning points: those are known only once the hand has come back by the hysteresis. Rest in
/// between makes no turning point and is counted as pause. Not real time.
class HalfStrokeFinder {
 public:
  struct Parameters {
    double period_s = 0.001;           ///< > 0.
    double hysteresis_m = 0.03;        ///< > 0; less than half of any stroke that shall count.
    double rest_speed_m_per_s = 0.02;  ///< Below it the hand rests, >= 0.
    double shortest_pause_s = 0.15;    ///< A shorter rest belongs to a turning point, >= 0.
  };

  /// Throws `core::Error` naming the field.
  explicit HalfStrokeFinder(const Parameters& parameters);

  /// Ticks without a gap, in their order. The half stroke that this tick completes, if any.
  std::optional<HalfStroke> feed(const HandTick& hand) noexcept;

  /// Forgets everything: a gap, or another presentation.
  void restart() noexcept { progress_ = {}; }

 private:
  /// What adds up over a half stroke.
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
    std::int64_t rest_ticks = 0;  ///< Up to now, without a break.
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
