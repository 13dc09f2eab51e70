#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::device {

/// What stands behind "plugin:" in a device's name.
struct PluginOptions {
  /// "hand", "./hand.so", "/opt/hand/hand.so": with a slash, or a file that is there, as it is;
  /// else looked for, see `plugin_file`.
  std::string name;
  bool says_simulated = false;  ///< The operator says that nobody can be hurt by it.
  bool says_real = false;       ///< The operator uses it as if somebody could.
  bool in_process = false;      ///< Without a process of its own: for measuring.
  std::string of_driver;        ///< "KEY=VALUE,KEY=VALUE", for the driver; or "".
};

/// "PATH" or "PATH:OPTION,...". Throws `core::Error`. Not real time.
[[nodiscard]] PluginOptions plugin_options(std::string_view argument);

/// The driver's file. A name without a slash that is no file here is looked for, with ".so"
/// behind it or not, in the folders of JND_DEVICE_PATH, with colons between, then in
/// lib/jnd/devices beside the folder of this program. Throws `DeviceUnreachable` saying where
/// it was looked for. Not real time.
[[nodiscard]] std::filesystem::path plugin_file(const std::string& name);

/// Every shared object in those folders, in their order, by name. Not real time.
[[nodiscard]] std::vector<std::filesystem::path> found_plugins();

/// The program that runs drivers, "jnd-device-host": what JND_DEVICE_HOST names, else beside
/// this program, else in libexec/jnd beside this program's folder. Throws `DeviceUnreachable`
/// if it is not there. Not real time.
[[nodiscard]] std::filesystem::path device_host_file();

}  // namespace jnd::device
