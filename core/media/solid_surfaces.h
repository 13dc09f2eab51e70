#pragma once

#include <array>
#include <cstdint>

#include "core/hand.h"
#include "core/haptic_state.h"
#include "core/media/god_object.h"
#include "core/media/immersion.h"
#include "core/media/medium.h"

namespace jnd::core {

/// The five points on all solid surfaces. Each point has surfaces of its own (`GodObject`),
/// with its share of the hand's amounts:
///
///   plane:      the surface of the `Immersion`, everywhere, solid below;
///   container:  the wall (a cylinder) and the bottom at the limits of the `Immersion`, where
///   they are not infinite. With an infinite radius the bottom is a floor below a fluid.
///
/// The container holds every point that was once in it below its rim, which is at the height of
/// the surface, until the point is lifted over the rim. From outside the container does not
/// exist, so it never draws a point in. The wall fades over its uppermost `kRimM`. Real time.
class SolidSurfaces {
 public:
  static constexpr double kRimM = 0.01;

  /// Writes the forces of this tick, in the workspace frame. A point that came off gets zero
  /// force and forgets what it touched; `release` makes all points forget. Call it once a tick
  /// while anything solid is there.
  void render(const MediumAmounts& medium, const Immersion& immersion,
              const ShareRatios& shares, const HapticState& state, double period_s,
              PointVectors& force_on_hand_n) noexcept;

  /// Bit i is 1 while the container holds point i. The point is then in its fluid, however hard
  /// it presses.
  [[nodiscard]] std::uint8_t held_bits() const noexcept { return held_bits_; }

  [[nodiscard]] static bool are_there(const MediumAmounts& medium) noexcept {
    return medium.plane().is_there() || medium.container().is_there();
  }

  void release() noexcept;

 private:
  struct Contacts {
    GodObject plane;
    GodObject wall;
    GodObject bottom;
  };
  void follow(const Immersion& immersion, const HapticState& state) noexcept;
  [[nodiscard]] Eigen::Vector3d container_force_n(const SolidAmounts& amounts, int point,
                                                  const HapticState& state,
                                                  double period_s) noexcept;
  void release(int point) noexcept;

  std::array<Contacts, kNumContactPoints> contacts_;
  std::uint8_t held_bits_ = 0;
  Immersion immersion_;
  bool is_released_ = true;
};

}  // namespace jnd::core
