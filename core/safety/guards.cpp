#include "core/safety/guards.h"

#include <utility>

#include "core/require.h"

namespace jnd::core {

Guards::Guards(const Parameters& parameters, double period_s)
    : parameters_(parameters),
      port_energy_(parameters.port_energy, period_s),
      oscillation_(parameters.oscillation, period_s),
      velocity_check_(parameters.velocity_check),
      stillness_(parameters.stillness, period_s) {
  require_bounded(parameters.workspace);
  require_not_negative(parameters.warn_margin_m, "warn_margin_m");
  require_positive(parameters.longest_s, "longest_s");
}

/// The guard of energy may be only counted if nobody can be hurt, so never on a real device.
bool Guards::is_shadowed(Fault guard) const noexcept {
  return parameters_.shadows && (guard != Fault::kEnergyGiven || parameters_.shadows_energy);
}

/// Returns the fault to latch. In shadow mode it returns none and counts the fault, once for as
/// long as it lasts.
Fault Guards::judged(Fault guard) noexcept {
  if (!is_shadowed(guard)) return guard;
  shadowed_bits_ |= 1U << guard_place(guard);
  return Fault::kNone;
}

/// Uses measurements alone: force and displacement of the same time, and the velocity from
/// which the forces are computed.
Fault Guards::observe_port(const HapticState& state, const Contact& contact,
                           double elapsed_s) noexcept {
  if (!parameters_.watches_port) return Fault::kNone;
  port_energy_.observe(state.tip_position_m, state.acted_n, state.attached,
                       contact.storing_bits);
  if (port_energy_.is_exceeded()) {
    if (is_shadowed(Fault::kEnergyGiven)) port_energy_.forgive();
    const Fault found = judged(Fault::kEnergyGiven);
    if (found != Fault::kNone) return found;
  }
  // If the device's clock leaps, no speed follows from it.
  if (elapsed_s > parameters_.longest_s) {
    velocity_check_.reset();
    return Fault::kNone;
  }
  velocity_check_.observe(state.tip_position_m, state.tip_velocity_m_per_s, state.attached,
                          elapsed_s);
  if (!velocity_check_.is_contradicted()) return Fault::kNone;
  if (is_shadowed(Fault::kVelocityContradicts)) velocity_check_.reset();
  return judged(Fault::kVelocityContradicts);
}

Fault Guards::observe_stillness(const HapticState& state, const Contact& contact,
                                double elapsed_s) noexcept {
  if (!parameters_.watches_stillness) return Fault::kNone;
  stillness_.observe(state.tip_position_m, state.tip_velocity_m_per_s, state.attached,
                     contact.pushed_bits, elapsed_s);
  if (!stillness_.is_frozen()) return Fault::kNone;
  if (is_shadowed(Fault::kPositionFrozen)) stillness_.reset();
  return judged(Fault::kPositionFrozen);
}

Fault Guards::observe_place(const HapticState& state) noexcept {
  is_near_edge_ = false;
  for (int i = 0; i < kNumContactPoints; ++i) {
    const Eigen::Vector3d& tip_m = state.tip_position_m[i];
    if (!state.attached[i] ||
        parameters_.workspace.contains_well(tip_m, parameters_.warn_margin_m)) {
      continue;
    }
    is_near_edge_ = true;
    if (!parameters_.workspace.contains(tip_m)) return judged(Fault::kOutsideWorkspace);
  }
  return Fault::kNone;
}

Fault Guards::observe_force(const PointVectors& force_on_hand_n) noexcept {
  if (!parameters_.watches_port) return Fault::kNone;
  Eigen::Vector3d whole_n = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& force_n : force_on_hand_n) whole_n += force_n;
  oscillation_.observe(whole_n);
  if (!oscillation_.is_found()) return Fault::kNone;
  if (is_shadowed(Fault::kForceOscillates)) oscillation_.reset();
  return judged(Fault::kForceOscillates);
}

void Guards::medium_changed() noexcept {
  oscillation_.reset();
  port_energy_.grant_credit();
}

void Guards::end_tick(bool may_have_force) noexcept {
  const auto bit_if = [](Fault guard, bool is_near) noexcept {
    return static_cast<unsigned>(is_near) << guard_place(guard);
  };
  const unsigned known_shadowed_bits = std::exchange(known_shadowed_bits_, shadowed_bits_);
  const unsigned begun_bits = std::exchange(shadowed_bits_, 0U) & ~known_shadowed_bits;
  unsigned warning_bits = 0;
  if (may_have_force) {
    warning_bits = bit_if(Fault::kOutsideWorkspace, is_near_edge_) |
                   bit_if(Fault::kPositionFrozen, stillness_.asks_to_move()) |
                   bit_if(Fault::kEnergyGiven, port_energy_.is_near()) |
                   bit_if(Fault::kForceOscillates, oscillation_.is_near()) |
                   bit_if(Fault::kVelocityContradicts, velocity_check_.is_near());
  }
  warning_ = Fault::kNone;
  for (std::size_t i = 0; (warning_bits | begun_bits) != 0 && i < kGuards.size(); ++i) {
    const bool warns = (warning_bits >> i & 1U) != 0;
    if (warns && warning_ == Fault::kNone) warning_ = kGuards[i];
    if (warns && (warned_bits_ >> i & 1U) == 0) ++counts_.num_warnings[i];
    if (may_have_force && (begun_bits >> i & 1U) != 0) ++counts_.num_shadowed[i];
  }
  warned_bits_ = warning_bits;
}

void Guards::reset() noexcept {
  port_energy_.reset();
  oscillation_.reset();
  velocity_check_.reset();
  stillness_.reset();
}

}  // namespace jnd::core
