#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace jnd::app {

/// A monitor that is plugged in.
struct Monitor {
  std::string name;        ///< The system's name for it, such as "HDMI-1".
  int x_px = 0, y_px = 0;  ///< Its upper left corner on the whole screen.
  int width_px = 0, height_px = 0;
  bool has_window = false;  ///< The experimenter's window is on it.

  friend bool operator==(const Monitor&, const Monitor&) = default;
};

/// Where the experimenter wants the participant's screen.
struct ScreenChoice {
  enum class Where {
    kOff,
    kMonitor,  ///< It fills the monitor of this name.
    kWindow,   ///< It is a window beside the experimenter's.
  };
  Where where = Where::kOff;
  std::string monitor;

  friend bool operator==(const ScreenChoice&, const ScreenChoice&) = default;
};

/// Stores the choice for the next start of the program on this machine, as one line in a file
/// of this folder. If the folder is "" or cannot be written, nothing is stored. Not real time.
void remember_screen(const std::filesystem::path& folder, const ScreenChoice& choice);
/// `kOff` if nothing was chosen, or if the file contains anything else.
[[nodiscard]] ScreenChoice remembered_screen(const std::filesystem::path& folder);

/// Where the participant's screen can be now.
struct ScreenPlace {
  /// If false, it is on `monitor`; if that is "", it is beside the experimenter's window.
  bool nowhere = true;
  std::string monitor;
  /// Why it is not where it was wanted, in a sentence; "" if it is.
  std::string problem;
};

/// Finds the place for a choice. The screen never covers the experimenter's window: a monitor
/// with that window is not used, even if it was chosen. A monitor that is not plugged in is
/// waited for.
[[nodiscard]] ScreenPlace place_of_screen(const ScreenChoice& choice,
                                          const std::vector<Monitor>& monitors);

/// A place that can be chosen: off, each other monitor, or, if there is none, a window beside
/// ours. The present choice is among the options even if it is not available now. `label` and
/// `kind` are for people, such as "HDMI-1" and "1920 × 1080".
struct ScreenOption {
  ScreenChoice choice;
  std::string label, kind;
};
[[nodiscard]] std::vector<ScreenOption> screen_options(const ScreenChoice& choice,
                                                       const std::vector<Monitor>& monitors);

/// Reads lines of "NAME X Y WIDTH HEIGHT" in pixels. They replace the system's monitors for a
/// test, or for a screen that is cut into several. Other lines are ignored.
[[nodiscard]] std::vector<Monitor> told_monitors(const std::filesystem::path& file);

}  // namespace jnd::app
