#include "app/operator/participant_place.h"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <sstream>
#include <system_error>

#include "app/language/words.h"

namespace jnd::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* kBesideWord = as_is("window");
constexpr const char* kMonitorWord = as_is("monitor ");

fs::path file_of_screen(const fs::path& folder) { return folder / "participant_screen"; }

bool is_name_of_monitor(const std::string& name) {
  constexpr std::size_t kMost = 128;
  return !name.empty() && name.size() <= kMost &&
         std::ranges::none_of(name, [](unsigned char sign) { return std::iscntrl(sign) != 0; });
}

const Monitor* monitor_named(const std::string& name, const std::vector<Monitor>& monitors) {
  const auto found = std::ranges::find(monitors, name, &Monitor::name);
  return found == monitors.end() ? nullptr : &*found;
}

}  // namespace

void remember_screen(const fs::path& folder, const ScreenChoice& choice) {
  if (folder.empty()) return;
  std::error_code ignored;
  if (choice.where == ScreenChoice::Where::kOff) {
    fs::remove(file_of_screen(folder), ignored);
    return;
  }
  const bool is_beside = choice.where == ScreenChoice::Where::kWindow;
  if (!is_beside && !is_name_of_monitor(choice.monitor)) return;
  fs::create_directories(folder, ignored);
  // The new file is written beside the old one and then replaces it, so a reader finds one or
  // the other.
  const fs::path fresh = file_of_screen(folder).string() + "." + std::to_string(::getpid());
  std::ofstream stream(fresh, std::ios::trunc);
  stream << (is_beside ? kBesideWord : kMonitorWord + choice.monitor) << '\n';
  stream.close();
  if (stream) fs::rename(fresh, file_of_screen(folder), ignored);
  fs::remove(fresh, ignored);
}

ScreenChoice remembered_screen(const fs::path& folder) {
  using Where = ScreenChoice::Where;
  if (folder.empty()) return {};
  std::ifstream stream(file_of_screen(folder));
  std::string line;
  std::getline(stream, line);
  if (line == kBesideWord) return {.where = Where::kWindow};
  if (!line.starts_with(kMonitorWord)) return {};
  const std::string name = line.substr(std::string(kMonitorWord).size());
  if (!is_name_of_monitor(name)) return {};
  return {.where = Where::kMonitor, .monitor = name};
}

ScreenPlace place_of_screen(const ScreenChoice& choice, const std::vector<Monitor>& monitors) {
  using Where = ScreenChoice::Where;
  if (choice.where == Where::kOff) return {};
  if (choice.where == Where::kWindow) return {.nowhere = false};
  const Monitor* monitor = monitor_named(choice.monitor, monitors);
  if (monitor == nullptr) {
    return {.problem =
                tr("The monitor {} is not plugged in: the participant sees nothing. Plug "
                   "it in, and the screen comes back, or choose another one.",
                   choice.monitor)};
  }
  if (monitor->has_window) {
    return {.problem =
                tr("This window is on {}, the participant's monitor: the participant sees "
                   "nothing. Move this window to the other monitor, or choose another "
                   "one.",
                   choice.monitor)};
  }
  return {.nowhere = false, .monitor = choice.monitor};
}

std::vector<ScreenOption> screen_options(const ScreenChoice& choice,
                                         const std::vector<Monitor>& monitors) {
  using Where = ScreenChoice::Where;
  std::vector<ScreenOption> options = {{{}, tr("Off"), ""}};
  bool has_choice = choice.where != Where::kMonitor;
  for (const Monitor& monitor : monitors) {
    const bool is_choice = !has_choice && monitor.name == choice.monitor;
    has_choice |= is_choice;
    if (monitor.has_window && !is_choice) continue;
    options.push_back({{.where = Where::kMonitor, .monitor = monitor.name},
                       monitor.name,
                       monitor.has_window ? tr("this window is on it")
                                          : std::to_string(monitor.width_px) + " × " +
                                                std::to_string(monitor.height_px)});
  }
  if (!has_choice) options.push_back({choice, choice.monitor, tr("not plugged in")});
  if (monitors.size() < 2 || choice.where == Where::kWindow) {
    options.push_back({{.where = Where::kWindow}, tr("A window beside this one"), ""});
  }
  return options;
}

std::vector<Monitor> told_monitors(const fs::path& file) {
  std::vector<Monitor> monitors;
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    Monitor monitor;
    std::istringstream words(line);
    words >> monitor.name >> monitor.x_px >> monitor.y_px >> monitor.width_px >>
        monitor.height_px;
    if (words && monitor.width_px > 0 && monitor.height_px > 0) monitors.push_back(monitor);
  }
  return monitors;
}

}  // namespace jnd::app
