#include "device/plugin/plugin_options.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "core/error.h"
#include "device/haptic_device.h"

namespace jnd::device {
namespace {

namespace fs = std::filesystem;

/// This leaves room for the rest of what the driver's process is told.
constexpr std::size_t kMostOptionBytes = 1000;

fs::path own_folder() {
  std::error_code ignored;
  return fs::read_symlink("/proc/self/exe", ignored).parent_path();
}

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::is_regular_file(path, ignored);
}

std::vector<fs::path> plugin_folders() {
  std::vector<fs::path> folders;
  if (const char* named = std::getenv("JND_DEVICE_PATH"); named != nullptr) {
    std::string_view rest = named;
    while (!rest.empty()) {
      const std::size_t colon = std::min(rest.find(':'), rest.size());
      if (colon > 0) folders.emplace_back(rest.substr(0, colon));
      rest.remove_prefix(std::min(colon + 1, rest.size()));
    }
  }
  folders.push_back(own_folder().parent_path() / "lib" / "jnd" / "devices");
  return folders;
}

void apply_plugin_option(std::string_view option, PluginOptions& options) {
  if (option == "simulated") {
    options.says_simulated = true;
  } else if (option == "real") {
    options.says_real = true;
  } else if (option == "in-process") {
    options.in_process = true;
  } else if (option.find('=') != std::string_view::npos && option.front() != '=') {
    options.of_driver += (options.of_driver.empty() ? "" : ",") + std::string(option);
  } else {
    throw core::Error(
        "device plugin: expected simulated, real, in-process or KEY=VALUE for the driver "
        "behind the path, with commas between, found \"" +
        std::string(option.substr(0, 80)) + "\"");
  }
}

}  // namespace

PluginOptions plugin_options(std::string_view argument) {
  const std::size_t colon = argument.find(':');
  PluginOptions options;
  options.name = argument.substr(0, colon);
  if (options.name.empty()) {
    throw core::Error("device plugin: expected the path of a driver, found \"" +
                      std::string(argument.substr(0, 80)) + "\"");
  }
  std::string_view rest =
      colon == std::string_view::npos ? std::string_view() : argument.substr(colon + 1);
  while (!rest.empty()) {
    const std::size_t comma = std::min(rest.find(','), rest.size());
    apply_plugin_option(rest.substr(0, comma), options);
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  if (options.says_simulated && options.says_real) {
    throw core::Error("device plugin: expected simulated or real, found both");
  }
  if (options.of_driver.size() > kMostOptionBytes) {
    throw core::Error("device plugin: expected options of at most " +
                      std::to_string(kMostOptionBytes) + " letters, found " +
                      std::to_string(options.of_driver.size()));
  }
  return options;
}

fs::path plugin_file(const std::string& name) {
  std::error_code ignored;
  const bool is_path = name.find('/') != std::string::npos;
  if (is_path || is_file(name)) {
    if (!is_file(name)) {
      throw DeviceUnreachable(
          "device plugin " + name +
          ": expected the shared object of a driver, found no such file; "
          "build it, or correct the path, which begins in the folder that jnd "
          "runs in");
    }
    return fs::absolute(name, ignored);
  }
  std::string looked_in;
  for (const fs::path& folder : plugin_folders()) {
    for (const fs::path& file : {folder / name, folder / (name + ".so")}) {
      if (is_file(file)) return fs::absolute(file, ignored);
    }
    looked_in += (looked_in.empty() ? "" : ", ") + folder.string();
  }
  throw DeviceUnreachable("device plugin " + name +
                          ": expected the shared object of a driver, found none of this name "
                          "here or in " +
                          looked_in +
                          "; give its path, or put its folder into JND_DEVICE_PATH");
}

std::vector<fs::path> found_plugins() {
  std::vector<fs::path> found;
  for (const fs::path& folder : plugin_folders()) {
    const std::size_t num_before = found.size();
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder, ignored)) {
      if (entry.path().extension() == ".so" && is_file(entry.path())) {
        found.push_back(entry.path());
      }
    }
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(num_before), found.end());
  }
  return found;
}

fs::path device_host_file() {
  const fs::path here = own_folder();
  if (const char* named = std::getenv("JND_DEVICE_HOST"); named != nullptr) {
    if (is_file(named)) return named;
    throw DeviceUnreachable(
        "JND_DEVICE_HOST: expected the program that runs drivers, found "
        "no file " +
        std::string(named) + "; correct the variable or unset it");
  }
  for (const fs::path& file :
       {here / "jnd-device-host", here.parent_path() / "libexec" / "jnd" / "jnd-device-host"}) {
    if (is_file(file)) return file;
  }
  throw DeviceUnreachable(
      "device plugin: expected the program jnd-device-host, in which "
      "drivers run, found none beside this program; install it anew");
}

}  // namespace jnd::device
