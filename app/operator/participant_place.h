#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace jnd::app {

/// A monitor that is plugged in.
struct Monitor {
  std::string name;        ///< As the system calls it: "HDMI-1".
  int x_px = 0, y_px = 0;  ///< Of its left upper corner on the whole screen.
  int width_px = 0, height_px = 0;
  bool has_window = false;  ///< The experimenter's window is on it.

  friend bool operator==(const Monitor&, const Monitor&) = default;
};

/// Where the experimenter wants the participant's screen.
struct ScreenChoice {
  enum class Where {
    kOff,
    kMonitor,  ///< Fills the monitor of this name.
    kWindow,   ///< A window beside the experimenter's.
  };
  Where where = Where::kOff;
  std::string monitor;

  friend bool operator==(const ScreenChoice&, const ScreenChoice&) = default;
};

/// Keeps the choice for the next start of the program on this machine, as one line in a file of
/// this folder. Where the folder is "", or cannot be written, nothing is kept. Not real time.
void remember_screen(const std::filesystem::path& folder, const ScreenChoice& choice);
/// Off where nothing was chosen, or where the file holds anything else.
[[nodiscard]] ScreenChoice remembered_screen(const std::filesystem::path& folder);

/// Where it can stand now.
struct ScreenPlace {
  /// On a monitor, or, where `monitor` is "", beside; not at all: `nowhere`.
  bool nowhere = true;
  std::string monitor;
  std::string problem;  ///< Why it is not where it was wanted, in a sentence; "" for nothing.
};

/// It never lies over the experimenter's window: a monitor that this is on is not used, even if
/// it was chosen. A monitor that is not plugged in is waited for.
[[nodiscard]] ScreenPlace place_of_screen(const ScreenChoice& choice,
                                          const std::vector<Monitor>& monitors);

/// What can be chosen: off, each other monitor, and, where there is none, a window beside. A
/// choice that stands but cannot be had now is among them. `label`: "HDMI-1", `kind`:
/// "1920 × 1080", for people.
struct ScreenOption {
  ScreenChoice choice;
  std::string label, kind;
};
[[nodiscard]] std::vector<ScreenOption> screen_options(const ScreenChoice& choice,
                                                       const std::vector<Monitor>& monitors);

/// Lines of "NAME X Y WIDTH HEIGHT", pixels: the monitors that a test, or a screen that is cut
/// into several, tells in place of the system's. What is no such line is left out.
[[nodiscard]] std::vector<Monitor> told_monitors(const std::filesystem::path& file);

}  // namespace jnd::app
