#pragma once

#include <filesystem>
#include <string>

namespace jnd::app {

/// Opens a file or folder with the desktop's program for it (xdg-open), and returns within 0.1
/// s. Returns "", or why it cannot be opened, with its path. Not real time.
[[nodiscard]] std::string open_outside(const std::filesystem::path& path);

}  // namespace jnd::app
