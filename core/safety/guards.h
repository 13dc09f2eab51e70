#pragma once

#include <cstdint>

#include "core/hand.h"
#include "core/haptic_state.h"
#include "core/safety/fault.h"
#include "core/safety/force_oscillation.h"
#include "core/safety/guard.h"
#include "core/safety/port_energy.h"
#include "core/safety/stillness_watch.h"
#include "core/safety/velocity_check.h"
#include "core/safety/workspace.h"

namespace jnd::core {

/// All guards (`kGuards`) together: where device and hand meet, the space in which force is
/// meant, and sensors that stand still. They see measurements and the force that is sent, and
/// say which fault that is; warn when one is half way to it; and in shadow mode only count what
/// they would have done. Real time except the constructor.
class Guards {
 public:
  struct Parameters {
    PortEnergy::Parameters port_energy;
    ForceOscillation::Parameters oscillation;
    VelocityCheck::Parameters velocity_check;
    StillnessWatch::Parameters stillness;
    Workspace workspace;
    double warn_margin_m = 0.020;  ///< To the edge of the workspace, >= 0.
    bool watches_port = true;      ///< Energy, swings and velocities.
    bool watches_stillness = true;
    bool shadows = false;         ///< Count instead of finding faults.
    bool shadows_energy = false;  ///< Of energy, too: where nobody can be hurt.
    double longest_s = 0.006;  ///< Of time between measurements that says something of speed.
  };

  /// Throws `Error` naming the field; a tick lasts `period_s`. Not real time.
  Guards(const Parameters& parameters, double period_s);

  /// What a surface or a float does with each point, a bit a point: holds or carries it, and
  /// pushes it with more than friction could hold it against.
  struct Contact {
    std::uint8_t storing_bits = 0;
    std::uint8_t pushed_bits = 0;
  };

  /// A measurement, `elapsed_s` > 0 after the one before by the device's clock: the port's.
  [[nodiscard]] Fault observe_port(const HapticState& state, const Contact& contact,
                                   double elapsed_s) noexcept;
  /// A measurement that is new, `elapsed_s` > 0 after the last new one by the loop's time: a
  /// sensor that died while the hand rested on something.
  [[nodiscard]] Fault observe_stillness(const HapticState& state, const Contact& contact,
                                        double elapsed_s) noexcept;
  /// Every measurement.
  [[nodiscard]] Fault observe_place(const HapticState& state) noexcept;
  /// The force that is sent to each point.
  [[nodiscard]] Fault observe_force(const PointVectors& force_on_hand_n) noexcept;
  /// The program itself changed the medium: that is no swing, and it may push the hand out.
  void medium_changed() noexcept;

  /// What the force of a point is multiplied by, 0 to 1.
  [[nodiscard]] double authority_ratio(int point) const noexcept {
    return parameters_.shadows ? 1.0 : stillness_.authority_ratio(point);
  }
  /// A force is being taken away until the hand moves.
  [[nodiscard]] bool asks_to_move() const noexcept {
    return stillness_.asks_to_move() && !parameters_.shadows;
  }

  /// At the end of each tick; counts only where there may be force.
  void end_tick(bool may_have_force) noexcept;
  /// The first guard that is close to its fault; none.
  [[nodiscard]] Fault warning() const noexcept { return warning_; }
  [[nodiscard]] const GuardCounts& counts() const noexcept { return counts_; }

  /// Forgets all but the counts, as before the first measurement.
  void reset() noexcept;

 private:
  [[nodiscard]] bool is_shadowed(Fault guard) const noexcept;
  [[nodiscard]] Fault judged(Fault guard) noexcept;

  Parameters parameters_;
  PortEnergy port_energy_;
  ForceOscillation oscillation_;
  VelocityCheck velocity_check_;
  StillnessWatch stillness_;
  bool is_near_edge_ = false;
  // A bit a guard, as in `kGuards`.
  unsigned warned_bits_ = 0;          ///< That warned in the last tick.
  unsigned shadowed_bits_ = 0;        ///< That would be faults in this tick.
  unsigned known_shadowed_bits_ = 0;  ///< In the last one.
  Fault warning_ = Fault::kNone;
  GuardCounts counts_;
};

}  // namespace jnd::core
