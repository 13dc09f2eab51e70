#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

/// Opens a file or folder with the program that the desktop has for it (xdg-open), and goes on
/// at once. Returns "" or why it cannot be opened. Not real time.
[[nodiscard]] std::string open_outside(const std::filesystem::path& path);

}  // namespace jnd::app
