#pragma once

#include <array>
#include <functional>
#include <string_view>

#include "device/stability.h"

namespace jnd::device {

/// How the hand is on the exoskeleton while its stability is measured.
enum class Contact {
  kAttached,  ///< Every magnet holds, whatever pulls.
  /// Every magnet lets go above `kSlippingBreakAwayN` and somebody puts the finger back at
  /// once.
  kSlipping,
  kDetached,  ///< No finger is on the hand.
};

inline constexpr std::array<std::string_view, 3> kContactNames = {"attached", "slipping",
                                                                  "detached"};
inline constexpr double kSlippingBreakAwayN = 1.0;

/// One row of the map.
struct StabilityCase {
  double rate_hz = 1000.0;
  double extra_delay_s = 0.0;  ///< Of the force, beyond the tick that it takes anyway.
  Contact contact = Contact::kAttached;
};

struct ExoskeletonStability {
  StabilityLimit viscosity_pa_s;     ///< Of a viscous fluid, force = 12 area / length mu v.
  StabilityLimit stiffness_n_per_m;  ///< Of the solid plane, without damping and friction.
};

/// The largest values for which the simulated exoskeleton settles (`settles`) after each of two
/// disturbances: every tip pushed by 4 N until it moves at 0.15 m/s, for 100 ms at most, all
/// the same way, and alternately to and fro; across the hand plane for a fluid, across the
/// surface for a plane that the lowest tip just touches and onto which every tip is pressed by
/// 1 N. The hand is held at home by its arm and nobody strokes.
///
/// The loop is told that every point is attached, whether or not it is: what the limiter knows
/// of attachment is out of the way, so that what it protects from can be seen.
///
/// `is_cancelled`, asked before every run, ends it by a throw of its own; may be empty. Throws
/// `core::Error` for a rate or delay the device cannot do. Not real time.
[[nodiscard]] ExoskeletonStability measure_stability(
    const StabilityCase& wanted, const std::function<void()>& is_cancelled = {});

/// One such run, for whoever wants to see a single value.
[[nodiscard]] bool is_stable_in(const StabilityCase& wanted, const core::MediumAmounts& medium);

}  // namespace jnd::device
