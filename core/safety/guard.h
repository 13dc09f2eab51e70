#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/safety/fault.h"

namespace jnd::core {

/// Guards are the faults that judge whether what a device reports and does is plausible. A
/// healthy hand could set them off. So each one warns before it becomes a fault, and in shadow
/// mode only counts what it would have done. All other faults are certain and act at once.
inline constexpr std::array kGuards{Fault::kOutsideWorkspace, Fault::kEnergyGiven,
                                    Fault::kForceOscillates, Fault::kVelocityContradicts,
                                    Fault::kPositionFrozen};

/// Returns the index in `kGuards`, or its size for a fault that is no guard. Real time.
[[nodiscard]] constexpr std::size_t guard_place(Fault fault) noexcept {
  for (std::size_t i = 0; i < kGuards.size(); ++i) {
    if (kGuards[i] == fault) return i;
  }
  return kGuards.size();
}

[[nodiscard]] constexpr bool is_guard(Fault fault) noexcept {
  return guard_place(fault) < kGuards.size();
}

/// What the guards have noticed, each at its index in `kGuards`.
struct GuardCounts {
  /// How often each guard began to warn.
  std::array<std::uint32_t, kGuards.size()> num_warnings{};
  std::array<std::uint32_t, kGuards.size()> num_shadowed{};  ///< Faults that were only counted.
};

/// Whether the force fades out after this guard's fault, instead of ending at once. A guard may
/// be wrong about a healthy hand, which a sudden end of the force would jolt. But the force
/// ends at once if the device gives the hand energy, and for all faults that are certain. Real
/// time.
[[nodiscard]] constexpr bool fades(Fault guard) noexcept {
  return is_guard(guard) && guard != Fault::kEnergyGiven;
}

/// Returns half a sentence for the experimenter while a guard warns, such as "the hand is near
/// the edge of its space". Real time.
[[nodiscard]] std::string_view warning_words(Fault guard) noexcept;

}  // namespace jnd::core
