#pragma once

#include <filesystem>

#include "core/controls/control.h"

namespace jnd::app {

/// In $XDG_CONFIG_HOME/jnd, or ~/.config/jnd where that is not set; "" without a home.
[[nodiscard]] std::filesystem::path kept_controls_file();

/// Which control does what on this machine, as it was kept; a damaged file counts as empty, as
/// do rows that no program of this version has written. Not real time.
[[nodiscard]] core::ControlMap kept_controls(const std::filesystem::path& file);

/// Keeps it, in one small file that is replaced whole. Throws `core::Error` if it cannot be
/// written; nothing where `file` is "".
void keep_controls(const std::filesystem::path& file, const core::ControlMap& map);

}  // namespace jnd::app
