#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/safety/fault.h"

namespace jnd::core {

/// Faults that judge whether what a device says and does is plausible, and that a healthy hand
/// could set off. Each warns before it becomes a fault, and in shadow mode it only says what it
/// would have done. All others are certain, and act at once.
inline constexpr std::array kGuards{Fault::kOutsideWorkspace, Fault::kEnergyGiven,
                                    Fault::kForceOscillates, Fault::kVelocityContradicts,
                                    Fault::kPositionFrozen};

/// Place in `kGuards`, or its size for a fault that is no guard's. Real time.
[[nodiscard]] constexpr std::size_t guard_place(Fault fault) noexcept {
  for (std::size_t i = 0; i < kGuards.size(); ++i) {
    if (kGuards[i] == fault) return i;
  }
  return kGuards.size();
}

[[nodiscard]] constexpr bool is_guard(Fault fault) noexcept {
  return guard_place(fault) < kGuards.size();
}

/// What the guards have noticed, each at its place in `kGuards`.
struct GuardCounts {
  std::array<std::uint32_t, kGuards.size()> num_warnings{};  ///< Times it began to warn.
  std::array<std::uint32_t, kGuards.size()> num_shadowed{};  ///< Faults that only were counted.
};

/// Whether the force fades once this guard has found its fault, instead of ending at once. It
/// may be wrong about a healthy hand, which a sudden end of the force would jolt. But what
/// gives the hand energy ends at once, and so does all that is certain. Real time.
[[nodiscard]] constexpr bool fades(Fault guard) noexcept {
  return is_guard(guard) && guard != Fault::kEnergyGiven;
}

/// Half a sentence for the experimenter while a guard warns: "the hand is near the edge of its
/// space". Real time.
[[nodiscard]] std::string_view warning_words(Fault guard) noexcept;

}  // namespace jnd::core
