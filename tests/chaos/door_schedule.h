#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::chaos {

/// How a device is connected to the program.
enum class Door : std::uint8_t {
  kDriver,        ///< In a process of its own.
  kPacingDriver,  ///< In a process of its own, and it sets the pace of the loop.
  kCDevice,       ///< The reference device in C, across the network.
  kPythonDevice,  ///< The reference device in Python.
  kServedDriver,  ///< A driver behind `jnd device-server`.
};
inline constexpr int kNumDoors = 5;

/// What goes wrong while the real program runs on the device.
enum class DoorTrouble : std::uint8_t {
  kProgramKilled,
  kProgramStopped,  ///< SIGSTOP, and continued after a while.
  kServerKilled,    ///< The server is killed, and started again at the same port.
  kServerStopped,
  kHostKilled,  ///< The process in which a driver runs is killed.
  kHostStopped,
  kUnplugged,   ///< Every call of the driver fails.
  kAllStopped,  ///< Program, server and driver stop, as when a machine sleeps.
};

struct DoorEvent {
  DoorTrouble what = DoorTrouble::kProgramKilled;
  /// True: it comes at once after the trouble before. False: it comes `after_ms` after the next
  /// force was seen.
  bool is_at_once = false;
  int after_ms = 0;
  int lasts_ms = 0;
  /// Whether somebody resumes before it is certain that the old force has gone.
  bool is_resumed_at_once = false;
};

/// Everything about one run. It is a pure function of the seed, but what happens in the run is
/// not, because it is played in real time.
struct DoorSchedule {
  std::uint64_t seed = 0;
  Door door = Door::kDriver;
  bool has_key = false;  ///< For a device across the network.
  unsigned points = 31;  ///< Points of a driver, one bit each.
  std::vector<DoorEvent> events;
  std::string wrong;  ///< What the device does wrong on purpose; "" for nothing.
};

[[nodiscard]] bool is_networked(Door door) noexcept;
[[nodiscard]] bool has_driver(Door door) noexcept;

[[nodiscard]] DoorSchedule drawn_door_schedule(std::uint64_t seed);
/// Returns a schedule in which the program stops or dies while a device gives wrong force on
/// purpose. The devices alternate: a driver that does not halt, one that gives more than
/// requested, and a device across the network that keeps its force.
[[nodiscard]] DoorSchedule wrong_door_schedule(std::uint64_t seed);
/// Whether this seed is one of the twentieth that are played through a door; each door comes
/// once in a hundred.
[[nodiscard]] bool is_played_through_a_door(std::uint64_t seed) noexcept;

/// Returns a few lines for a person.
[[nodiscard]] std::string told(const DoorSchedule& schedule);
[[nodiscard]] std::string_view name(Door door) noexcept;
[[nodiscard]] std::string_view name(DoorTrouble what) noexcept;

}  // namespace jnd::chaos
