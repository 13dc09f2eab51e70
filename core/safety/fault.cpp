#include "core/safety/fault.h"

namespace jnd::core {

std::string_view name(Fault fault) noexcept {
  switch (fault) {
    case Fault::kNone:
      return "none";
    case Fault::kEmergencyStop:
      return "emergency_stop";
    case Fault::kNonFiniteState:
      return "non_finite_state";
    case Fault::kNonFiniteForce:
      return "non_finite_force";
    case Fault::kDeviceReadFailed:
      return "device_read_failed";
    case Fault::kDeviceWriteFailed:
      return "device_write_failed";
    case Fault::kStaleSample:
      return "stale_sample";
    case Fault::kPositionJump:
      return "position_jump";
    case Fault::kOverVelocity:
      return "over_velocity";
    case Fault::kHeartbeatLost:
      return "heartbeat_lost";
  }
  return "unknown";
}

std::string_view words(Fault fault) noexcept {
  switch (fault) {
    case Fault::kNone:
      return "No fault.";
    case Fault::kEmergencyStop:
      return "The emergency stop was pressed: make sure that the participant is well, release "
             "the stop, then arm the device again.";
    case Fault::kNonFiniteState:
      return "The device reported a position or velocity that is not a number: check its "
             "sensors and cables, then arm it again.";
    case Fault::kNonFiniteForce:
      return "The computed force was not a number and was not sent: note the stimulus, report "
             "it as a bug, then arm the device again.";
    case Fault::kDeviceReadFailed:
      return "The device could not be read: check its power and connection, then arm it again.";
    case Fault::kDeviceWriteFailed:
      return "The device did not take the force: check its power and connection, then arm it "
             "again.";
    case Fault::kStaleSample:
      return "The device kept sending the same measurement: check that it is still running, "
             "then arm it again.";
    case Fault::kPositionJump:
      return "A contact point jumped further than a hand can move: check whether a finger came "
             "loose or the device was unplugged, then arm it again.";
    case Fault::kOverVelocity:
      return "A contact point moved faster than allowed: calm the movement, check that nothing "
             "came loose, then arm the device again.";
    case Fault::kHeartbeatLost:
      return "The program's window stopped answering, so the force was faded out: wait until "
             "it "
             "answers, then arm the device again.";
  }
  return "Unknown fault: stop the session.";
}

}  // namespace jnd::core
