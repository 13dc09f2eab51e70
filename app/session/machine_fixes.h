#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace jnd::app {

/// The system that is looked at, and the user for whom.
struct FixedSystem {
  /// The folder that contains etc, usr/lib/udev and sys.
  std::filesystem::path root = "/";
  std::filesystem::path shipped;  ///< The folder data/system.
  /// The user who runs sessions; "" if nobody is named.
  std::string user;
};

/// One thing that an administrator can set up for the user who runs sessions.
struct MachineFix {
  std::string name;
  bool ok = false;
  std::string found;
  /// Lines for a shell of root, in order. None if a person has to do it.
  std::vector<std::string> commands;
  /// What a person has to do in addition; "" if nothing.
  std::string remedy;
};

/// The group for which the rules of `data/system` are made.
inline constexpr const char* kSessionGroup = "jnd";

/// What exists and what is missing, in the order in which it has to be set up: the group, its
/// members, its limits, its devices, and the processors' clocks. Changes nothing.
[[nodiscard]] std::vector<MachineFix> machine_fixes(const FixedSystem& system);

/// Whether the system knows a user of this name.
[[nodiscard]] bool has_user(const FixedSystem& system, const std::string& user);

}  // namespace jnd::app
