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

/// All guards (`kGuards`) together. They watch the interaction of device and hand, the space in
/// which force is allowed, and sensors that stand still. They take the measurements and the
/// forces that are sent, and return faults. They warn when a fault is half reached, and in
/// shadow mode only count. Real time except the constructor.
class Guards {
 public:
  struct Parameters {
    PortEnergy::Parameters port_energy;
    ForceOscillation::Parameters oscillation;
    VelocityCheck::Parameters velocity_check;
    StillnessWatch::Parameters stillness;
    Workspace workspace;
    /// Distance to the edge of the workspace at which it warns, >= 0.
    double warn_margin_m = 0.020;
    bool watches_port = true;  ///< Watch energy, oscillation and velocities.
    bool watches_stillness = true;
    bool shadows = false;  ///< Count faults instead of returning them.
    /// In shadow mode, count also the guard of energy; only if nobody can be hurt.
    bool shadows_energy = false;
    /// Longest time between two measurements from which a speed follows.
    double longest_s = 0.006;
  };

  /// Throws `Error` naming the field. `period_s` is the duration of a tick. Not real time.
  Guards(const Parameters& parameters, double period_s);

  /// What a surface or buoyancy does with each point. Bit i of `storing_bits`: it holds or
  /// carries point i. Bit i of `pushed_bits`: it pushes point i with more force than friction
  /// could resist.
  struct Contact {
    std::uint8_t storing_bits = 0;
    std::uint8_t pushed_bits = 0;
  };

  /// Checks energy and velocity of a measurement that came `elapsed_s` > 0 after the one
  /// before, by the device's clock.
  [[nodiscard]] Fault observe_port(const HapticState& state, const Contact& contact,
                                   double elapsed_s) noexcept;
  /// A measurement that is new, `elapsed_s` > 0 after the last new one by the loop's time: a
  /// sensor that died while the hand rested on something.
  [[nodiscard]] Fault observe_stillness(const HapticState& state, const Contact& contact,
                                        double elapsed_s) noexcept;
  /// Every measurement.
  [[nodiscard]] Fault observe_place(const HapticState& state) noexcept;
  /// Checks the force that is sent to each point.
  [[nodiscard]] Fault observe_force(const PointVectors& force_on_hand_n) noexcept;
  /// Tells that the program itself changed the medium. The change counts as no turn, and the
  /// new medium may push the hand out.
  void medium_changed() noexcept;

  /// Factor on the force of a point, 0 to 1.
  [[nodiscard]] double authority_ratio(int point) const noexcept {
    return parameters_.shadows ? 1.0 : stillness_.authority_ratio(point);
  }
  /// Whether a force is being taken away until the hand moves.
  [[nodiscard]] bool asks_to_move() const noexcept {
    return stillness_.asks_to_move() && !parameters_.shadows;
  }

  /// Ends a tick. Warnings count only while there may be force.
  void end_tick(bool may_have_force) noexcept;
  /// Returns the first guard that is close to its fault, or none.
  [[nodiscard]] Fault warning() const noexcept { return warning_; }
  [[nodiscard]] const GuardCounts& counts() const noexcept { return counts_; }

  /// Forgets everything but the counts, as before the first measurement.
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
  // One bit for each guard, by its index in `kGuards`.
  unsigned warned_bits_ = 0;          ///< Guards that warned in the last tick.
  unsigned shadowed_bits_ = 0;        ///< Guards that would be faults in this tick.
  unsigned known_shadowed_bits_ = 0;  ///< The same in the last tick.
  Fault warning_ = Fault::kNone;
  GuardCounts counts_;
};

}  // namespace jnd::core
