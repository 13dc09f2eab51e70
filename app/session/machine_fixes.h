#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace jnd::app {

/// Whose files are looked at, and for whom.
struct FixedSystem {
  std::filesystem::path root = "/";  ///< Holds etc, usr/lib/udev and sys.
  std::filesystem::path shipped;     ///< The folder data/system.
  std::string user;                  ///< Who runs sessions; "": nobody is named.
};

/// One thing that an administrator can give to whoever runs sessions.
struct MachineFix {
  std::string name;
  bool ok = false;
  std::string found;
  /// Lines for a shell of root, in their order. None where a person has to do it.
  std::vector<std::string> commands;
  std::string remedy;  ///< What a person has to do besides; "" if nothing.
};

/// The group that the rules of `data/system` are about.
inline constexpr const char* kSessionGroup = "jnd";

/// What there is and what is lacking, of the group, its members, its limits, its devices and
/// the processors' clocks, in the order in which it is to be mended. Changes nothing.
[[nodiscard]] std::vector<MachineFix> machine_fixes(const FixedSystem& system);

/// Whether the system knows a user of this name.
[[nodiscard]] bool has_user(const FixedSystem& system, const std::string& user);

}  // namespace jnd::app
