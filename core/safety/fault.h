#pragma once

#include <cstdint>
#include <string_view>

namespace jnd::core {

/// Why the haptic loop renders no force. Latched: the first one stays until the loop is armed,
/// but an emergency stop takes the place of any other.
/// The numbers are stored in recordings: append, never renumber.
enum class Fault : std::uint8_t {
  kNone = 0,
  kEmergencyStop = 1,
  kNonFiniteState = 2,
  kNonFiniteForce = 3,
  kDeviceReadFailed = 4,
  kDeviceWriteFailed = 5,
  kStaleSample = 6,
  kPositionJump = 7,
  kOverVelocity = 8,
  kHeartbeatLost = 9,
  kOutsideWorkspace = 10,
  kWatchdog = 11,
  kLinkLost = 12,
  kSimulationInvalid = 13,
  kNotArmed = 14,  ///< Nobody has asked for force yet; nothing is wrong.
  kSuspended = 15,
  kHostTooSlow = 16,
  kEnergyGiven = 17,
  kForceOscillates = 18,
  kVelocityContradicts = 19,
  kActingForceUnknown = 20,
  kNotEnabled = 21,
  kPositionFrozen = 22,
};
inline constexpr Fault kLastFault = Fault::kPositionFrozen;

/// Whether something went wrong or somebody stopped it.
[[nodiscard]] constexpr bool is_failure(Fault fault) noexcept {
  return fault != Fault::kNone && fault != Fault::kNotArmed;
}

/// Whether the device's driver may say more of it.
[[nodiscard]] constexpr bool is_of_driver(Fault fault) noexcept {
  return fault == Fault::kDeviceReadFailed || fault == Fault::kDeviceWriteFailed ||
         fault == Fault::kNonFiniteState;
}

/// Whether there may be force. Force comes only after a person has asked for it, or, with a
/// simulated device, the program.
enum class Arming : std::uint8_t {
  kDisarmed = 0,  ///< Nobody has asked for force.
  kArming = 1,    ///< The force fades in.
  kArmed = 2,
  kFaulted = 3,  ///< A fault is latched; there is no force until the loop is armed again.
};

/// Returns "disarmed" and its like, as events and JSON spell them. Real time.
[[nodiscard]] std::string_view name(Arming arming) noexcept;

/// Returns "emergency_stop" and its like, as events and JSON spell them. Real time.
[[nodiscard]] std::string_view name(Fault fault) noexcept;

/// Returns one sentence for the experimenter: what happened and what to do. Real time.
[[nodiscard]] std::string_view words(Fault fault) noexcept;

}  // namespace jnd::core
