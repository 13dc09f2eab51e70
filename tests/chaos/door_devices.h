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

/// What a machine may lack: a compiler of C, Python, the program. Drivers and devices are
/// compiled once for all schedules.
class DoorTools {
 public:
  /// Those of this machine.
  [[nodiscard]] static const DoorTools& here();

  [[nodiscard]] bool has(Door door) const;
  [[nodiscard]] const std::filesystem::path& driver() const noexcept { return driver_; }
  [[nodiscard]] const std::filesystem::path& c_device() const noexcept { return c_device_; }

 private:
  DoorTools();
  std::filesystem::path driver_, c_device_;  ///< Empty: could not be made.
  bool has_program_ = false, has_python_ = false;
};

/// The device of a schedule and, where it has one, its server. Everything is in `folder`.
class DoorDevice {
 public:
  DoorDevice(const DoorSchedule& schedule, std::filesystem::path folder);

  /// What stands behind `--device`.
  [[nodiscard]] std::string words() const;
  [[nodiscard]] test_support::ProgramOptions options() const;

  /// Of a device across the network; at the port that it had before, if any. False: the port
  /// is not to be had.
  [[nodiscard]] bool serve();
  void kill_server();
  /// What became of a server that has ended by itself; none if it runs.
  [[nodiscard]] std::optional<test_support::ProgramOutcome> ended_server();
  void signal_server(int number) const;
  [[nodiscard]] bool is_served() const { return server_.has_value(); }
  /// The process in which the newest driver runs; -1: none.
  [[nodiscard]] pid_t host() const;

  void plug_in(bool is_in) const;
  /// From now on: whether the device has force that is of a program to come.
  void await_force();
  [[nodiscard]] bool has_new_force();
  /// All devices that were open, one after the other.
  [[nodiscard]] std::vector<ForceLog> logs() const;
  /// Limits, and for how long a force may stand that nobody renews.
  [[nodiscard]] Happenings promised() const;
  /// From the last command of a program on.
  [[nodiscard]] int force_ends_within_ms() const;
  /// From the last command to a driver on, whoever gives it.
  [[nodiscard]] int driver_force_ends_within_ms() const;
  /// For so long whoever has the device across the network, or else the driver's process, may
  /// stand still without an end of the force.
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
