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

/// Tools that a machine may lack: a C compiler, Python and the program. Drivers and devices are
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
  std::filesystem::path driver_, c_device_;  ///< A path is empty if the file could not be made.
  bool has_program_ = false, has_python_ = false;
};

/// Runs the device of a schedule and, if it has one, its server. All files are in `folder`.
class DoorDevice {
 public:
  DoorDevice(const DoorSchedule& schedule, std::filesystem::path folder);

  /// Returns the words after `--device`.
  [[nodiscard]] std::string words() const;
  [[nodiscard]] test_support::ProgramOptions options() const;

  /// Serves a device across the network, at the same port as before, if it had one. Returns
  /// false if the port is taken.
  [[nodiscard]] bool serve();
  void kill_server();
  /// Returns the outcome of a server that ended by itself, or nothing while it runs.
  [[nodiscard]] std::optional<test_support::ProgramOutcome> ended_server();
  void signal_server(int number) const;
  [[nodiscard]] bool is_served() const { return server_.has_value(); }
  /// Returns the process in which the newest driver runs, or -1 if there is none.
  [[nodiscard]] pid_t host() const;

  void plug_in(bool is_in) const;
  /// Makes `has_new_force` report only the force of a program that is yet to come.
  void await_force();
  [[nodiscard]] bool has_new_force();
  /// Returns the logs of all devices that were open, one after the other.
  [[nodiscard]] std::vector<ForceLog> logs() const;
  /// Returns the device's limits, and for how long a force may stand without being renewed.
  [[nodiscard]] Happenings promised() const;
  /// Returns within which time after the last command of a program the force ends.
  [[nodiscard]] int force_ends_within_ms() const;
  /// Returns within which time after the last command to a driver the force ends, whoever gave
  /// the command.
  [[nodiscard]] int driver_force_ends_within_ms() const;
  /// Returns for how long the process that has the device may stand still without an end of the
  /// force. This is the server's process across the network, and otherwise the driver's.
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
