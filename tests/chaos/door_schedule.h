#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::chaos {

/// The ways in which a device comes to the program.
enum class Door : std::uint8_t {
  kDriver,        ///< A driver in a process of its own.
  kPacingDriver,  ///< Such a driver that also sets the pace of the loop.
  kCDevice,       ///< The reference device in C, across the network.
  kPythonDevice,  ///< The reference device in Python, across the network.
  kServedDriver,  ///< A driver behind `jnd device-server`.
};
inline constexpr int kNumDoors = 5;

/// What goes wrong while the real program runs on the device.
enum class DoorTrouble : std::uint8_t {
  kProgramKilled,
  kProgramStopped,  ///< SIGSTOP, and SIGCONT after a while.
  kServerKilled,    ///< The server is started again at the same port.
  kServerStopped,
  kHostKilled,  ///< The process in which a driver runs is killed.
  kHostStopped,
  kUnplugged,   ///< Every call of the driver fails.
  kAllStopped,  ///< Program, server and driver stop, as when a machine sleeps.
};

struct DoorEvent {
  DoorTrouble what = DoorTrouble::kProgramKilled;
  /// If true, the event follows the trouble before it at once. Otherwise it comes `after_ms`
  /// after the next force was seen.
  bool is_at_once = false;
  int after_ms = 0;
  int lasts_ms = 0;
  /// Whether somebody resumes before it is certain that the old force has gone.
  bool is_resumed_at_once = false;
};

/// Everything that is drawn for one run, as a pure function of its seed. What then happens also
/// depends on the machine, because the run is played in real time.
struct DoorSchedule {
  std::uint64_t seed = 0;
  Door door = Door::kDriver;
  bool has_key = false;  ///< Only devices across the network can have a key.
  unsigned points = 31;  ///< The points of a driver, one bit for each.
  std::vector<DoorEvent> events;
  std::string wrong;  ///< What the device does wrong on purpose, or "" for nothing.
};

[[nodiscard]] bool is_networked(Door door) noexcept;
[[nodiscard]] bool has_driver(Door door) noexcept;

[[nodiscard]] DoorSchedule drawn_door_schedule(std::uint64_t seed);
/// Draws a schedule in which the program stops or dies while a device that is wrong on purpose
/// gives force. By turns, this is a driver that does not halt, one that gives more than it was
/// asked for, and a device across the network that keeps its force.
[[nodiscard]] DoorSchedule wrong_door_schedule(std::uint64_t seed);
/// Returns whether this seed is played through a door. This is so for one seed in twenty, and
/// each door has its turn once in a hundred.
[[nodiscard]] bool is_played_through_a_door(std::uint64_t seed) noexcept;

/// Describes the schedule in a few lines for a person.
[[nodiscard]] std::string told(const DoorSchedule& schedule);
[[nodiscard]] std::string_view name(Door door) noexcept;
[[nodiscard]] std::string_view name(DoorTrouble what) noexcept;

}  // namespace jnd::chaos
