#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

struct DoctorFixOptions {
  bool dry_run = false;
  bool json = false;
  std::string user;  ///< "" for the user who called this program or sudo.
  /// The root of the system that is set up.
  std::filesystem::path root = "/";
};

/// Says what the machine lacks for sessions, and as root sets it up; without root, or with
/// `dry_run`, it only says the commands. Throws `EnvironmentError` if something is left that it
/// may not do, or that failed.
[[nodiscard]] int run_doctor_fix(const DoctorFixOptions& options);

}  // namespace jnd::app
