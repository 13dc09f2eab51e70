#pragma once

#include <sys/types.h>

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "chaos/door_schedule.h"
#include "chaos/force_log.h"
#include "support/program.h"

namespace jnd::chaos {

/// Tools that a machine may lack: a C compiler, Python, the program. Drivers and devices are
/// compiled once for all schedules.
class DoorTools {
 public:
  /// Returns the tools of this machine.
  [[nodiscard]] static const DoorTools& here();

  [[nodiscard]] bool has(Door door) const;
  [[nodiscard]] const std::filesystem::path& driver() const noexcept { return driver_; }
  [[nodiscard]] const std::filesystem::path& c_device() const noexcept { return c_device_; }

 private:
  DoorTools();
  std::filesystem::path driver_, c_device_;  ///< Empty if they could not be made.
  bool has_program_ = false, has_python_ = false;
};

/// The device of a schedule and, if it has one, its server. Everything is in `folder`.
class DoorDevice {
 public:
  DoorDevice(const DoorSchedule& schedule, std::filesystem::path folder);

  /// Returns what follows `--device`.
  [[nodiscard]] std::string words() const;
  [[nodiscard]] test_support::ProgramOptions options() const;

  /// For a device across the network: serves it, at the port that it had before, if any.
  /// Returns false if the port is not available.
  [[nodiscard]] bool serve();
  void kill_server();
  /// Returns the result of a server that has ended by itself, or none if it runs.
  [[nodiscard]] std::optional<test_support::ProgramOutcome> ended_server();
  void signal_server(int number) const;
  [[nodiscard]] bool is_served() const { return server_.has_value(); }
  /// Returns the process in which the newest driver runs, or -1.
  [[nodiscard]] pid_t host() const;

  void plug_in(bool is_in) const;
  /// From now on, tells whether the device gets force from a program that starts later.
  void await_force();
  [[nodiscard]] bool has_new_force();
  /// Returns the logs of all devices that were open, one after another.
  [[nodiscard]] std::vector<ForceLog> logs() const;
  /// Returns the limits, and how long a force may persist that nobody renews.
  [[nodiscard]] Happenings promised() const;
  /// The time within which the force ends, counted from the last command of a program.
  [[nodiscard]] int force_ends_within_ms() const;
  /// The time within which the force ends, counted from the last command to a driver, whoever
  /// gives it.
  [[nodiscard]] int driver_force_ends_within_ms() const;
  /// The party that has the device across the network, or otherwise the driver's process, may
  /// stand still for this long without an end of the force.
  [[nodiscard]] int longest_pause_ms() const;

 private:
  void draw_key();
  [[nodiscard]] std::string driver_words() const;
  [[nodiscard]] std::vector<std::filesystem::path> log_files() const;

  const DoorSchedule& schedule_;
  std::filesystem::path folder_;
  std::string key_file_;
  std::string place_;
  int num_servers_ = 0;
  std::map<std::filesystem::path, ForceWatch> watches_;
  std::optional<test_support::RunningProgram> server_;
};

}  // namespace jnd::chaos
