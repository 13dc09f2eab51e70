#pragma once

#include <cstdint>
#include <string_view>

namespace jnd::core {

/// Why the haptic loop renders no force. Latched: the first one stays until the loop is armed
/// again. The numbers are stored in recordings: append, never renumber.
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
};
inline constexpr Fault kLastFault = Fault::kSimulationInvalid;

/// "emergency_stop", as events and JSON spell it. Real time.
[[nodiscard]] std::string_view name(Fault fault) noexcept;

/// One sentence for the experimenter: what happened and what to do. Real time.
[[nodiscard]] std::string_view words(Fault fault) noexcept;

}  // namespace jnd::core
