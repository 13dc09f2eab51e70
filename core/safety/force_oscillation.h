#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace jnd::core {

/// Detects that the total force oscillates faster than a hand can make it, as it does when a
/// control loop has become unstable and buzzes within its limits. A turn is a reversal of one
/// component of the force after a change of at least `swing_n`. `max_turns` of them within
/// `window_s` are too many. Tremor stays below 12 Hz (Elble and Koller 1990), which makes 6
/// turns in a quarter of a second. Real time except the constructor.
class ForceOscillation {
 public:
  static constexpr int kMostTurns = 32;

  struct Parameters {
    double swing_n = 2.0;    ///< Peak to peak, > 0, finite.
    double window_s = 0.25;  ///< > 0, finite.
    /// In [2, kMostTurns]. The default is that of 20 Hz in the default window.
    int max_turns = 10;
  };

  /// Throws `Error` naming the field; `period_s` > 0. Not real time.
  ForceOscillation(const Parameters& parameters, double period_s);

  /// Takes the total force on the hand of the next tick, in the workspace frame.
  void observe(const Eigen::Vector3d& force_n) noexcept;

  [[nodiscard]] bool is_found() const noexcept { return is_found_; }
  /// Whether some axis turned more than three quarters of `max_turns` times within the last
  /// window, which is faster than tremor.
  [[nodiscard]] bool is_near() const noexcept { return tick_ <= near_until_tick_; }

  /// Forgets everything. What follows starts from zero force.
  void reset() noexcept;

 private:
  struct Axis {
    double extreme_n = 0.0;  ///< The extreme that the force has reached since its last turn.
    bool is_rising = true;
    int next = 0;  ///< Index of the oldest turn.
    /// Ticks of the turns. At first they lie long ago.
    std::array<std::int64_t, kMostTurns> turns{};
  };

  double swing_n_;
  std::int64_t window_ticks_;
  int max_turns_;
  std::int64_t tick_ = 0;
  std::int64_t near_until_tick_ = -1;
  bool is_found_ = false;
  std::array<Axis, 3> axes_;
};

}  // namespace jnd::core
