#pragma once

#include <cstdint>

namespace jnd::core {

/// In how many ticks there was what it takes for a hand to feel a force, so far or in some
/// time. A count of the later ones that stays 0 says what was missing.
struct ForceCounts {
  std::uint64_t num_held = 0;      ///< The device told that a point holds the hand.
  std::uint64_t num_immersed = 0;  ///< Such a point was where the medium is.
  std::uint64_t num_moved = 0;     ///< Such a point moved, by the velocity that it tells.
  std::uint64_t num_sent = 0;      ///< A force was sent to the device.
  /// A force acted, by what the device tells and by its sensors of force; where it tells
  /// neither, one was sent.
  std::uint64_t num_acted = 0;

  friend ForceCounts operator-(const ForceCounts& a, const ForceCounts& b) noexcept {
    return {a.num_held - b.num_held, a.num_immersed - b.num_immersed, a.num_moved - b.num_moved,
            a.num_sent - b.num_sent, a.num_acted - b.num_acted};
  }
};

}  // namespace jnd::core
