#pragma once

#include <array>
#include <cstdint>

#include <Eigen/Core>

namespace jnd::core {

/// Notices that the whole force swings to and fro faster than a hand can make it: a control
/// loop that has become unstable and buzzes within its limits. A swing is a turn of one
/// component of the force after a change of at least `swing_n`; `max_turns` of them within
/// `window_s` are too many. Tremor stays below 12 Hz (Elble and Koller 1990), which is 6 turns
/// in a quarter of a second. Real time except the constructor.
class ForceOscillation {
 public:
  static constexpr int kMostTurns = 32;

  struct Parameters {
    double swing_n = 2.0;    ///< Peak to peak, > 0, finite.
    double window_s = 0.25;  ///< > 0, finite.
    int max_turns = 10;      ///< In [2, kMostTurns]: of 20 Hz, in the window.
  };

  /// Throws `Error` naming the field; `period_s` > 0. Not real time.
  ForceOscillation(const Parameters& parameters, double period_s);

  /// The whole force on the hand in the next tick; workspace frame.
  void observe(const Eigen::Vector3d& force_n) noexcept;

  [[nodiscard]] bool is_found() const noexcept { return is_found_; }
  /// Some axis turned more than three quarters as often within the last window: faster than
  /// tremor.
  [[nodiscard]] bool is_near() const noexcept { return tick_ <= near_until_tick_; }

  /// Forgets all: what comes next starts from zero force.
  void reset() noexcept;

 private:
  struct Axis {
    double extreme_n = 0.0;  ///< As far as the force has come since its last turn.
    bool is_rising = true;
    int next = 0;                                  ///< The place of the oldest turn.
    std::array<std::int64_t, kMostTurns> turns{};  ///< Their ticks; long ago at first.
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
