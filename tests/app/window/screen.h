#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace jnd::app {

/// What the window shows, as the program itself reports it.
struct Screen {
  struct Widget {
    std::string name, label;
    std::string key;  ///< The key as it is printed on the control, for example "Ctrl Z".
    int x = 0, y = 0, width = 0, height = 0;  ///< The place in pixels of the window.
    bool enabled = false;
  };
  std::string view;
  std::uint64_t frame = 0;
  std::vector<Widget> widgets;
  std::vector<std::string> texts;

  [[nodiscard]] const Widget* find(std::string_view name) const;
  /// Returns whether the widget exists, can be seen and is enabled.
  [[nodiscard]] bool offers(std::string_view name) const;
  /// Returns whether some text contains `part`.
  [[nodiscard]] bool shows(std::string_view part) const;
  /// Returns the first text that begins with this, or "" if none does.
  [[nodiscard]] std::string text_after(std::string_view beginning) const;
};

/// Reads what the program wrote about its last frame that showed anything new. The result is
/// empty before the first such frame.
[[nodiscard]] Screen read_screen(const std::filesystem::path& file);

/// Describes the screen in words, for the message of a failed wait.
[[nodiscard]] std::string described(const Screen& screen);

}  // namespace jnd::app
