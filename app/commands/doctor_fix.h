#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

struct DoctorFixOptions {
  bool dry_run = false;
  bool json = false;
  std::string user;                  ///< "": whoever called, or called sudo.
  std::filesystem::path root = "/";  ///< Of the system that is mended.
};

/// Says what the machine lacks for sessions, and as root gives it; without root, or with
/// `dry_run`, it says the commands alone. Throws `EnvironmentError` where something is left
/// to do that it may not do, or that failed.
[[nodiscard]] int run_doctor_fix(const DoctorFixOptions& options);

}  // namespace jnd::app
