#include "core/safety/fault.h"

#include "core/for_people.h"

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
    case Fault::kOutsideWorkspace:
      return "outside_workspace";
    case Fault::kWatchdog:
      return "watchdog";
    case Fault::kLinkLost:
      return "link_lost";
    case Fault::kSimulationInvalid:
      return "simulation_invalid";
    case Fault::kNotArmed:
      return "not_armed";
    case Fault::kSuspended:
      return "suspended";
    case Fault::kHostTooSlow:
      return "host_too_slow";
    case Fault::kEnergyGiven:
      return "energy_given";
    case Fault::kForceOscillates:
      return "force_oscillates";
    case Fault::kVelocityContradicts:
      return "velocity_contradicts";
    case Fault::kActingForceUnknown:
      return "acting_force_unknown";
    case Fault::kNotEnabled:
      return "not_enabled";
    case Fault::kPositionFrozen:
      return "position_frozen";
  }
  return "unknown";
}

std::string_view words(Fault fault) noexcept {
  switch (fault) {
    case Fault::kNone:
      return for_people("No fault.");
    case Fault::kEmergencyStop:
      return for_people(
          "The emergency stop was pressed: make sure that the participant is well, release the "
          "stop, then arm the device again.");
    case Fault::kNonFiniteState:
      return for_people(
          "The device reported a position or velocity that is not a number: check its sensors "
          "and cables, then arm it again.");
    case Fault::kNonFiniteForce:
      return for_people(
          "The computed force was not a number and was not sent: note the stimulus, report it "
          "as a bug, then arm the device again.");
    case Fault::kDeviceReadFailed:
      return for_people(
          "The device could not be read: check its power and connection, then arm it again.");
    case Fault::kDeviceWriteFailed:
      return for_people(
          "The device did not take the force: check its power and connection, then arm it "
          "again.");
    case Fault::kStaleSample:
      return for_people(
          "The device kept sending the same measurement: check that it is still running, then "
          "arm it again.");
    case Fault::kPositionJump:
      return for_people(
          "A contact point jumped further than a hand can move: check whether a finger came "
          "loose or the device was unplugged, then arm it again.");
    case Fault::kOverVelocity:
      return for_people(
          "A contact point moved faster than allowed: calm the movement, check that nothing "
          "came loose, then arm the device again.");
    case Fault::kHeartbeatLost:
      return for_people(
          "The program stopped answering (its window was minimised or held up, or a slow disk "
          "or this machine held the session up), so the force was faded out: see that the stop "
          "is in sight and the program answers, then arm the device again.");
    case Fault::kOutsideWorkspace:
      return for_people(
          "A contact point left the space in which force may be given: bring the hand back to "
          "the middle, then arm the device again.");
    case Fault::kWatchdog:
      return for_people(
          "The haptic loop stopped for longer than allowed and the watchdog took the force "
          "away: close what burdens this machine, then arm the device again.");
    case Fault::kLinkLost:
      return for_people(
          "The connection to the device broke off or became too bad: check the network and the "
          "device's own program, then arm it again.");
    case Fault::kSimulationInvalid:
      return for_people(
          "The simulated apparatus came to a state that no real one can have and was stopped: "
          "leave the session and resume it, which starts the simulation anew; this trial does "
          "not count.");
    case Fault::kNotArmed:
      return for_people(
          "There is no force before somebody arms the device: make sure that the hand lies "
          "well in it and that the stop is within reach, then arm it.");
    case Fault::kSuspended:
      return for_people(
          "This machine slept, or was paused, in the middle of the session: make sure that it "
          "does not do so again, then arm the device.");
    case Fault::kHostTooSlow:
      return for_people(
          "This machine is too slow for the loop: no new measurement came while ticks were "
          "missed; close what burdens it, look at `jnd doctor`, then arm the device again.");
    case Fault::kEnergyGiven:
      return for_people(
          "The force moved the hand along instead of holding it back: the device answers too "
          "late or wrongly for so strong a medium; weaken the stimulus or measure the device, "
          "then arm it again.");
    case Fault::kForceOscillates:
      return for_people(
          "The force swung to and fro faster than a hand can move: the loop is unstable with "
          "so strong a medium; weaken the stimulus or measure the device, then arm it again.");
    case Fault::kVelocityContradicts:
      return for_people(
          "The velocity that the device reports is not that of its positions: check its signs, "
          "units and filters and that its time is in ns, then arm it again.");
    case Fault::kActingForceUnknown:
      return for_people(
          "The device does not tell which force acted while it measured, or tells more than it "
          "can give, so nobody could see it push the hand: its driver has to tell the true "
          "force, in N, before it is armed.");
    case Fault::kNotEnabled:
      return for_people(
          "The enabling switch of the device is open: whoever holds it closes it, then arm the "
          "device.");
    case Fault::kPositionFrozen:
      return for_people(
          "A contact point stood still to the last digit while its force went away or its "
          "velocity said that it moved: check that its sensor is alive, then arm the device "
          "again.");
  }
  return for_people("Unknown fault: stop the session.");
}

std::string_view name(Arming arming) noexcept {
  switch (arming) {
    case Arming::kDisarmed:
      return "disarmed";
    case Arming::kArming:
      return "arming";
    case Arming::kArmed:
      return "armed";
    case Arming::kFaulted:
      return "faulted";
  }
  return "unknown";
}

}  // namespace jnd::core
