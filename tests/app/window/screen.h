#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::app {

/// What the window shows, as it reports itself.
struct Screen {
  struct Widget {
    std::string name, label;
    std::string key;                          ///< As printed on it: "Ctrl Z".
    int x = 0, y = 0, width = 0, height = 0;  ///< In pixels of the window.
    bool enabled = false;
  };
  std::string view;
  std::uint64_t frame = 0;
  std::vector<Widget> widgets;
  std::vector<std::string> texts;

  [[nodiscard]] const Widget* find(std::string_view name) const;
  /// Whether the widget is visible and enabled.
  [[nodiscard]] bool offers(std::string_view name) const;
  /// Whether some text contains it.
  [[nodiscard]] bool shows(std::string_view part) const;
  /// Returns the first text that begins with this, or "".
  [[nodiscard]] std::string text_after(std::string_view beginning) const;
};

/// Reads what the program wrote about its last frame that showed anything new. Empty before the
/// first one.
[[nodiscard]] Screen read_screen(const std::filesystem::path& file);

/// Returns the same in words, for a test that waited for something else.
[[nodiscard]] std::string described(const Screen& screen);

}  // namespace jnd::app
