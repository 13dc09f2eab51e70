#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace jnd::app::gui {

struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< Rows from the top, four bytes a pixel.
};

/// Writes a PNG, whole or not at all. Throws `core::Error`.
void write_png(const std::filesystem::path& file, const Picture& picture);
/// Throws `core::Error` for what is no PNG.
[[nodiscard]] Picture read_png(const std::filesystem::path& file);

/// A part of it, as far as it lies inside.
[[nodiscard]] Picture cut_out(const Picture& picture, int x, int y, int width, int height);

}  // namespace jnd::app::gui
