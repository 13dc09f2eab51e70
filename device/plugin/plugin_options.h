#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::device {

/// What follows "plugin:" in a device's name.
struct PluginOptions {
  /// "hand", "./hand.so" or "/opt/hand/hand.so". A name with a slash, or of an existing file,
  /// is used as it is. Others are looked for, see `plugin_file`.
  std::string name;
  bool says_simulated = false;  ///< The operator says that nobody can be hurt by it.
  bool says_real = false;       ///< The operator uses it as if it could hurt somebody.
  bool in_process = false;      ///< Without a process of its own; for measurements.
  std::string of_driver;        ///< "KEY=VALUE,KEY=VALUE" for the driver, or "".
};

/// Reads "PATH" or "PATH:OPTION,...". Throws `core::Error`. Not real time.
[[nodiscard]] PluginOptions plugin_options(std::string_view argument);

/// Returns the driver's file. A name without a slash that is no file here is looked for, with
/// and without ".so", in the folders of JND_DEVICE_PATH (separated by colons), then in
/// lib/jnd/devices beside the folder of this program. Throws `DeviceUnreachable` that lists
/// where it looked. Not real time.
[[nodiscard]] std::filesystem::path plugin_file(const std::string& name);

/// Returns every shared object in those folders, folder by folder, sorted by name. Not real
/// time.
[[nodiscard]] std::vector<std::filesystem::path> found_plugins();

/// Returns the program that runs drivers, "jnd-device-host": the file in JND_DEVICE_HOST, or
/// one beside this program, or one in libexec/jnd beside this program's folder. Throws
/// `DeviceUnreachable` if it is missing. Not real time.
[[nodiscard]] std::filesystem::path device_host_file();

}  // namespace jnd::device
