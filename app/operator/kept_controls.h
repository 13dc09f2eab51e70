#pragma once

#include <filesystem>

#include "core/controls/control.h"

namespace jnd::app {

/// The file in $XDG_CONFIG_HOME/jnd, or in ~/.config/jnd if that is not set; "" if there is no
/// home folder.
[[nodiscard]] std::filesystem::path kept_controls_file();

/// Reads which control does what on this machine. A damaged file counts as empty, and so do
/// rows that no program of this version has written. Not real time.
[[nodiscard]] core::ControlMap kept_controls(const std::filesystem::path& file);

/// Stores the map in one small file, which is replaced as a whole. Throws `core::Error` if it
/// cannot be written. Does nothing if `file` is "".
void keep_controls(const std::filesystem::path& file, const core::ControlMap& map);

}  // namespace jnd::app
