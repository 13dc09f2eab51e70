#pragma once

#include <array>
#include <functional>
#include <string_view>

#include "device/stability.h"

namespace jnd::device {

/// How the hand is attached to the exoskeleton while its stability is measured.
enum class Contact {
  kAttached,  ///< Every magnet holds, whatever pulls.
  /// Every magnet lets go above `kSlippingBreakAwayN`, and somebody puts the finger back at
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
  /// Delay of the force, beyond the one tick that it always takes.
  double extra_delay_s = 0.0;
  Contact contact = Contact::kAttached;
};

struct ExoskeletonStability {
  StabilityLimit viscosity_pa_s;     ///< For a viscous fluid, force = 12 area / length mu v.
  StabilityLimit stiffness_n_per_m;  ///< For the solid plane, without damping and friction.
};

/// Returns the largest values for which the simulated exoskeleton settles (`settles`) after
/// each of two disturbances. Every tip is pushed by 4 N until it moves at 0.15 m/s, for 100 ms
/// at most: all in the same direction, and alternately to and fro. The push is across the hand
/// plane for a fluid, and across the surface for a plane. The lowest tip just touches the
/// plane, and every tip is pressed onto it by 1 N. The arm holds the hand at home and nobody
/// strokes.
///
/// The loop is told that every point is attached, whether it is or not. So the limiter, which
/// otherwise knows of detached points, does not hide the instability from which it protects.
///
/// `is_cancelled` is called before every run and may throw to stop; it may be empty. Throws
/// `core::Error` for a rate or delay that the device cannot do. Not real time.
[[nodiscard]] ExoskeletonStability measure_stability(
    const StabilityCase& wanted, const std::function<void()>& is_cancelled = {});

/// Does one such run, to see a single value.
[[nodiscard]] bool is_stable_in(const StabilityCase& wanted, const core::MediumAmounts& medium);

}  // namespace jnd::device
