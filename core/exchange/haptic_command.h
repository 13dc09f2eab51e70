#pragma once

#include <cstdint>
#include <type_traits>

#include "core/media/immersion.h"
#include "core/media/medium.h"

namespace jnd::core {

/// What the experimenter's side tells the haptic loop. Trivially copyable, because it crosses
/// to the haptic thread through a `LatestValue`.
struct HapticCommand {
  /// Increases by one with every command. Samples repeat the number of the command in force; 0
  /// means "no command yet".
  std::uint64_t sequence = 0;
  MediumAmounts medium;   ///< Free space by default.
  Immersion immersion;    ///< Infinite surface by default.
  double ramp_s = 0.050;  ///< Time over which the medium changes, >= 0. Never a force step.
  /// Of a step of a stimulus that goes on, the sequence of the command that began it; 0: this
  /// one begins another. What a stimulus may give back is granted once, however many steps.
  std::uint64_t stimulus = 0;
};

static_assert(std::is_trivially_copyable_v<HapticCommand>);

}  // namespace jnd::core
